# SPDX-License-Identifier: MIT
"""What the tests of the Python module share."""
import importlib.util
import sys
import unittest


def need(*packages):
    """Ends the script as skipped where one of these is missing: (module, Debian's package)."""
    for module, package in packages:
        if importlib.util.find_spec(module) is None:
            print(f"skipped: no {module} (Debian and Ubuntu: apt install {package})")
            sys.exit(77)


class Case(unittest.TestCase):
    def assertRefused(self, kind, line, function, *arguments, **options):
        """The exception's text is exactly this line."""
        with self.assertRaises(kind) as caught:
            function(*arguments, **options)
        self.assertEqual(str(caught.exception), line)
