"""Contents of `cmake --install`: a program and tools that run, a manual, and headers with which
another project computes the same results as the program, to the last bit.

CMAKE, BUILD (the folder that is installed), CXX, CMAKE_GENERATOR and MPIEXEC must be set in the
environment."""

import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

import h5py

HERE = pathlib.Path(__file__).resolve().parent
SLENDERNESS, RESTITUTION, FREQUENCY = 0.17457163, 0.9, 3.0
AMPLITUDES = (2.0, 3.5, 4.0)  # safe and unsafe; none overturns during the pulse
JOB = f"""
[scene]
pulse = "one_sine"
[plane]
frequency = {{ values = [{FREQUENCY}] }}
amplitude = {{ values = {list(AMPLITUDES)} }}
restitution = {{ values = [{RESTITUTION}] }}
slenderness = {{ values = [{SLENDERNESS}] }}
[output]
fields = ["region", "angle", "velocity", "margin"]
"""


class AnInstallation(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory(prefix="overturn-install-")
        cls.addClassCleanup(folder.cleanup)
        cls.folder = pathlib.Path(folder.name)
        cls.prefix = cls.folder / "prefix"
        run(os.environ["CMAKE"], "--install", os.environ["BUILD"], "--prefix", cls.prefix)
        cls.overturn = cls.prefix / "bin" / "overturn"
        (cls.folder / "job.toml").write_text(JOB)
        cls.spectrum = cls.folder / "spectrum.h5"
        run(os.environ["MPIEXEC"], "-n", "2", cls.overturn, "run",
            cls.folder / "job.toml", "-o", cls.spectrum)

    def test_the_program_prints_its_version(self):
        self.assertRegex(run(self.overturn, "--version"), r"^overturn \d+\.\d+\.\d+ ")

    def test_its_jobs_are_valid(self):
        jobs = self.prefix / "share/overturn/jobs"
        self.assertEqual({job.name for job in jobs.glob("*.toml")},
                         {job.name for job in (HERE.parents[1] / "jobs").glob("*.toml")})
        for job in ("smoke", "synthetic", "statues"):  # the last two refer to other files
            run(self.overturn, "check", jobs / f"{job}.toml")

    def test_another_project_computes_the_same_results_as_the_program(self):
        build = self.folder / "consumer"
        run(os.environ["CMAKE"], "-S", HERE / "consumer", "-B", build, "-DCMAKE_BUILD_TYPE=Release",
            "-DCMAKE_CXX_FLAGS_RELEASE=-O1 -Wall -Werror", f"-DCMAKE_PREFIX_PATH={self.prefix}")
        run(os.environ["CMAKE"], "--build", build)
        regions = set()
        with h5py.File(self.spectrum) as file:
            for i, amplitude in enumerate(AMPLITUDES):
                computed = run(build / "one_block", SLENDERNESS, RESTITUTION, FREQUENCY, amplitude)
                stored = [file[field][0, 0, i, 0]
                          for field in ("region", "angle", "velocity", "margin")]
                self.assertEqual([float(word) for word in computed.split()], stored)
                regions.add(int(stored[0]))
        self.assertGreater(len(regions), 1)

    def test_every_tool_is_a_command_listed_in_the_manual(self):
        manual = (pathlib.Path(os.environ["BUILD"]) / "src/commands/overturn.1").read_text()
        tools = sorted((self.prefix / "bin").glob("overturn-*"))
        self.assertGreater(len(tools), 5)
        for tool in {tool.read_text(): tool for tool in tools}.values():  # equal scripts run the tool of their name
            name = tool.name.removeprefix("overturn-").replace("-", "_")
            self.assertIn(f"usage: {name}", run(tool, "--help"))
        for tool in tools:
            self.assertIn(tool.name.replace("-", "\\-"), manual)
            self.assertTrue((self.prefix / f"share/man/man1/{tool.name}.1.gz").exists())

    def test_every_module_of_the_tools_is_there_and_tools_work(self):
        sources, installed = HERE.parents[1] / "tools/overturn", self.prefix / "share/overturn/tools/overturn"
        self.assertEqual(*({str(path.relative_to(folder)) for path in folder.rglob("*.py")}
                           for folder in (sources, installed)))
        jobs = self.prefix / "share/overturn/jobs"
        for tool, *arguments, output in (
                ("plot-spectrum", self.spectrum, "spectrum.png"), ("to-csv", self.spectrum, "spectrum.csv"),
                ("synthetic-record", "record.AT2"),
                ("rock", jobs / "rock.obj", "--contacts", jobs / "rock_contacts.csv", "rock.csv")):
            run(self.prefix / f"bin/overturn-{tool}", *arguments, "-o", self.folder / output)
            self.assertGreater((self.folder / output).stat().st_size, 100, tool)

    def test_the_python_package_has_its_module_beside_it(self):
        tools = self.prefix / "share/overturn/tools"
        if not list((tools / "overturn").glob("_core.*")):
            self.skipTest("the build has no Python module")
        script = (f"import sys; sys.path.insert(0, {str(tools)!r}); import overturn; "
                  f"print(overturn.evaluate(slenderness={SLENDERNESS}, restitution={RESTITUTION}, "
                  f"frequency={FREQUENCY}, amplitude={list(AMPLITUDES)}, method='rk45')['margin'].tobytes().hex()); "
                  f"print(overturn.check({str(self.folder / 'job.toml')!r}))")
        shown = run(sys.executable, "-c", script)
        with h5py.File(self.spectrum) as file:
            self.assertEqual(shown.splitlines()[0], file["margin"][0, 0, :, 0].tobytes().hex())
        self.assertIn("points ", shown)

    @unittest.skipUnless(shutil.which("man") and shutil.which("groff"), "no man or groff")
    def test_man_shows_the_manual_without_a_warning(self):
        page = self.prefix / "share/man/man1/overturn.1.gz"
        shown = subprocess.run(["man", "--warnings", "-l", page], capture_output=True, text=True,
                               env={**os.environ, "LC_ALL": "C.UTF-8", "MANWIDTH": "100"})
        self.assertEqual((shown.returncode, shown.stderr), (0, ""))
        for words in ("overturn boundary JOB", "--patience", "Exit", "OUT.h5"):
            self.assertIn(words.casefold(), shown.stdout.casefold())

    def test_bash_completes_subcommands_options_choices_and_files(self):
        for line, expected in (("overturn ver", ["verify"]), ("overturn run --dur", ["--durable"]),
                               ("overturn run --kernel avx", ["avx2", "avx512"]),
                               ("overturn check j", ["job.toml"]), ("overturn info sp", ["spectrum.h5"]),
                               ("overturn run job.toml -o sp", ["spectrum.h5"]),
                               ("overturn run --set scene.p", ["scene.pulse="]),
                               ("overturn boundary --set plane.size.", ["plane.size.values=", "plane.size.first=",
                                                                        "plane.size.last=", "plane.size.count=",
                                                                        "plane.size.spacing="]),
                               ("overturn topple --set plane", []),
                               ("overturn history --at pulse_p", ["pulse_period="]),
                               ("overturn run --set scene.pulse = o", [])):
            self.assertEqual(self.completions_of(line), expected, line)

    def completions_of(self, line):
        script = self.prefix / "share/bash-completion/completions/overturn"
        words = line.split()
        text = (f"source '{script}'; compopt() {{ :; }}; COMP_WORDS=({' '.join(words)}); "
                f"COMP_CWORD={len(words) - 1}; _overturn; printf '%s\\n' \"${{COMPREPLY[@]}}\"")
        shown = subprocess.run(["bash", "-c", text], cwd=self.folder, check=True,
                               capture_output=True, text=True)
        return shown.stdout.split()


def run(*command):
    """Runs a command with the Python of the tests first on the PATH, where the tools find it."""
    path = os.pathsep.join([os.path.dirname(sys.executable), os.environ["PATH"]])
    done = subprocess.run([str(word) for word in command], text=True, stdin=subprocess.DEVNULL,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                          env={**os.environ, "PATH": path})
    if done.returncode != 0:
        raise AssertionError(f"{command} exited with {done.returncode}:\n{done.stdout}")
    return done.stdout


if __name__ == "__main__":
    unittest.main()
