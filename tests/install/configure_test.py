"""Refusals when the build is configured. Requires CMAKE and CXX in the environment."""

import os
import pathlib
import subprocess
import tempfile
import unittest

SOURCE = pathlib.Path(__file__).resolve().parents[2]
# Replace CMake's own modules; the configuration ends at the package searched after HDF5.
FIND_MODULES = {"MPI": "set(MPI_FOUND TRUE)",
                "HDF5": "set(HDF5_FOUND TRUE)\nset(HDF5_IS_PARALLEL TRUE)",
                "Boost": 'message(FATAL_ERROR "HDF5 was accepted")'}


class AConfiguration(unittest.TestCase):
    def with_hdf5(self, version, *options):
        """Returns the output of CMake if it finds this HDF5."""
        with tempfile.TemporaryDirectory(prefix="overturn-test-") as folder:
            for name, text in FIND_MODULES.items():
                (pathlib.Path(folder) / f"Find{name}.cmake").write_text(text + "\n")
            run = subprocess.run(
                [os.environ["CMAKE"], "-S", SOURCE, "-B", f"{folder}/build", "-G", "Ninja",
                 f"-DCMAKE_MODULE_PATH={folder}", f"-DHDF5_VERSION={version}",
                 "-DCMAKE_CXX_COMPILER_WORKS=ON", "-DCMAKE_C_COMPILER_WORKS=ON", *options],
                capture_output=True, text=True, timeout=100)
        self.assertNotEqual(run.returncode, 0)
        return " ".join(run.stderr.split())

    def test_refuses_hdf5_that_cannot_disable_file_locking(self):
        for version in ("1.10.0", "1.10.6", "1.12.0"):
            self.assertIn(f"HDF5 {version} was found. overturn needs 1.10.7 or later, but not "
                          "1.12.0", self.with_hdf5(version))

    def test_accepts_hdf5_that_can_disable_file_locking(self):
        for version in ("1.10.7", "1.12.1", "1.14.3"):
            self.assertIn("HDF5 was accepted", self.with_hdf5(version))

    def test_refuses_unknown_kernels(self):
        self.assertIn('OVERTURN_KERNELS is "avx2", but must be all or native.',
                      self.with_hdf5("1.14.3", "-DOVERTURN_KERNELS=avx2"))


if __name__ == "__main__":
    unittest.main()
