"""Result files of other versions of the format are refused."""

import unittest

import h5py
import numpy as np

from program import Scratch


class AnotherFormat(Scratch):
    def test_is_refused_by_the_program_and_by_the_tools(self):
        self.assert_exit(self.overturn("run", "small.toml"), 0)
        for version, advice in ((3, "Use an older program, or compute the file again"),
                                (2, "Use an older program"), (6, "Use a newer program")):
            with h5py.File(self.folder / "small.h5", "r+") as file:
                file.attrs.modify("format_version", np.int64(version))
            before = (self.folder / "small.h5").read_bytes()
            refused = f"has format version {version}, but this program reads versions 4 and 5. {advice}"
            for command in (["info", "small.h5"], ["verify", "small.h5"]):
                self.assert_exit(self.overturn(*command), 74, refused)
            self.assert_exit(self.overturn("run", "small.toml"), 74, refused, "Choose another name with -o")
            self.assertEqual((self.folder / "small.h5").read_bytes(), before)
            drawn = self.tool("plot_spectrum", "small.h5")
            self.assertEqual(drawn.returncode, 74, drawn.stderr)
            self.assertIn("newer" if version > 5 else str(version), drawn.stderr)


if __name__ == "__main__":
    unittest.main(verbosity=2)
