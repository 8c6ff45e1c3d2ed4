# SPDX-License-Identifier: MIT
"""A library of another version, or with other structs, is an ImportError that names both."""
import os
import shutil
import subprocess
import sys
import tempfile
import unittest

from support import Case, need

need(("numpy", "python3-numpy"))
import glssao

HOME = os.path.dirname(glssao.__file__)


def import_error(change=lambda text: text, **environment):
    """What importing a copy of the module says whose _layout.py is changed."""
    with tempfile.TemporaryDirectory() as folder:
        copy = os.path.join(folder, "glssao")
        shutil.copytree(HOME, copy)
        with open(os.path.join(copy, "_layout.py"), "r+", encoding="utf-8") as file:
            text = change(file.read())
            file.seek(0)
            file.write(text)
        done = subprocess.run([sys.executable, "-c", "import glssao"], capture_output=True, text=True,
                              env={**os.environ, **environment, "PYTHONPATH": folder})
        return done.stderr.strip().splitlines()[-1] if done.returncode else ""


class Import(Case):
    def test_unchanged_copy_is_imported(self):
        self.assertEqual(import_error(), "")

    def test_other_version_is_named(self):
        message = import_error(lambda text: text.replace(f'VERSION = "{glssao.__version__}"', 'VERSION = "99.1.2"'))
        self.assertRegex(message, rf"^ImportError: this is glssao 99\.1\.2, but .* is of glssao {glssao.__version__}$")

    def test_other_layout_is_named(self):
        message = import_error(lambda text: text.replace('("radius", c_float)', '("radius", c_double)'))
        self.assertRegex(message, rf"^ImportError: this is glssao {glssao.__version__}, but .* is of glssao "
                                  rf"{glssao.__version__}; glssao_settings has \d+ bytes here and \d+ there$")

    def test_missing_and_foreign_libraries_are_named(self):
        self.assertRegex(import_error(GLSSAO_LIBRARY="/no/such.so"), r"^ImportError: glssao \S+: /no/such.so: .*GLSSAO_LIBRARY")
        self.assertRegex(import_error(GLSSAO_LIBRARY="libc.so.6"), r"^ImportError: glssao \S+ does not fit its library: .*glssao_")


if __name__ == "__main__":
    unittest.main()
