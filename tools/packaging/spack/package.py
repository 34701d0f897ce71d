# A recipe for Spack. It has not been run: tell us what had to be changed.
#
#   spack repo create overturn-repo && mkdir overturn-repo/packages/overturn
#   cp tools/packaging/spack/package.py overturn-repo/packages/overturn/
#   spack repo add overturn-repo && spack dev-build overturn@main

from spack.package import *


class Overturn(CMakePackage):
    """Overturning spectra of rocking blocks, in parallel under MPI."""

    license("MIT")
    version("main")  # of a checkout, for dev-build

    variant("python", default=True, description="Build the Python module")

    depends_on("cxx", type="build")
    depends_on("c", type="build")
    depends_on("cmake@3.25:", type="build")
    depends_on("pkgconfig", type="build")
    depends_on("git", type="build")  # the commit is part of the version
    depends_on("gzip", type="build")
    depends_on("mpi@3.1:")
    depends_on("hdf5@1.10.7:1.10,1.12.1: +mpi +hl")
    depends_on("boost@1.74:")
    depends_on("tomlplusplus@3.3:")
    depends_on("cli11@2.1:")
    depends_on("fmt@9: +shared")
    depends_on("nlohmann-json@3.11:")
    depends_on("xsimd@8:")
    depends_on("xxhash")
    depends_on("python@3.11:", when="+python", type=("build", "run"))
    depends_on("py-pybind11@2.10:", when="+python", type="build")
    for package in ("py-numpy", "py-h5py", "py-matplotlib", "py-scipy", "py-xarray", "py-h5netcdf"):
        depends_on(package, when="+python", type="run")

    def cmake_args(self):
        return [self.define("OVERTURN_TESTS", False)]

    def setup_run_environment(self, env):
        env.prepend_path("PYTHONPATH", self.prefix.share.overturn.tools)
