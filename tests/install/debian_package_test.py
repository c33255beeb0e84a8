#!/usr/bin/env python3
"""Makes the Debian package of a build, lays it out in an empty folder, and works with what is there.

    debian_package_test.py --build BUILD --cpack CPACK

The folder is outside of the tree, so that the program finds nothing but what the package brought. Exits with 77 where a
tool that makes or reads the package is not installed.
"""

import argparse
import gzip
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
TOOLS = ("dpkg-deb", "dpkg-shlibdeps", "dpkg-query", "readelf", "file", "man", "bash", "node")
GIVEN = argparse.Namespace()


def run(*command, environment=None):
    ended = subprocess.run([str(word) for word in command], capture_output=True, text=True, check=False,
                           stdin=subprocess.DEVNULL, env=environment, timeout=300)
    if ended.returncode != 0:
        raise AssertionError(f"{' '.join(map(str, command))} ended with {ended.returncode}\n{ended.stdout}{ended.stderr}")
    return ended.stdout


class DebianPackage(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="gumcert_package_"))
        cls.addClassCleanup(shutil.rmtree, cls.folder)
        # Whoever makes a package may keep new files to himself; those of the package are for all.
        before = os.umask(0o077)
        try:
            # Packages that are given to people are smaller and take a minute more.
            run(GIVEN.cpack, "-G", "DEB", "-B", cls.folder, "--config", GIVEN.build / "CPackConfig.cmake",
                "-D", "CPACK_DEBIAN_COMPRESSION_TYPE=gzip")
        finally:
            os.umask(before)
        cls.packages = list(cls.folder.glob("*.deb"))
        cls.root = cls.folder / "root"
        run("dpkg-deb", "--extract", cls.packages[0], cls.root)
        cls.doc = cls.root / "usr/share/doc/gumcert"
        cls.gumcert = cls.root / "usr/bin/gumcert"
        # Nothing of the machine but its programs: the templates are found beside the program.
        cls.environment = {"PATH": "/usr/local/bin:/usr/bin:/bin", "HOME": str(cls.folder), "LC_ALL": "C.UTF-8",
                           "MANWIDTH": "100"}

    def field(self, name):
        return run("dpkg-deb", "--field", self.packages[0], name).strip()

    def test_is_one_package_that_names_what_it_needs(self):
        self.assertEqual(len(self.packages), 1)
        version = re.search(r"project\(gumcert VERSION (\S+)", (ROOT / "CMakeLists.txt").read_text())[1]
        architecture = run("dpkg", "--print-architecture").strip()
        self.assertEqual(self.packages[0].name, f"gumcert_{version}-1_{architecture}.deb")
        self.assertEqual(self.field("Package"), "gumcert")
        self.assertEqual(self.field("Version"), f"{version}-1")
        self.assertRegex(self.field("Maintainer"), r"^[^<>]+ <[^<>@]+@[^<>@]+>$")
        for line in self.field("Description").splitlines():
            self.assertLessEqual(len(line), 80)
        needed = self.field("Depends")
        for name in (r"nodejs \(>= 18\)", "fonts-noto-cjk", "libc6", r"libcholmod\d+", r"libqpdf\d+", r"libssl\d+",
                     r"libstdc\+\+6", "libxml2", "libxmlsec1-openssl"):
            self.assertRegex(needed, rf"(^|, ){name}(,| |$)")
        for alternatives in needed.split(", "):
            names = [alternative.split()[0] for alternative in alternatives.split(" | ")]
            states = [subprocess.run(["dpkg-query", "--show", "--showformat=${db:Status-Status}", name],
                                     capture_output=True, text=True, check=False).stdout for name in names]
            self.assertIn("installed", states, f"{alternatives}: no package of this name on a machine that built it")

    def test_files_belong_to_root_and_can_be_read_by_all(self):
        listing = run("dpkg-deb", "--contents", self.packages[0]).splitlines()
        self.assertGreater(len(listing), 200)
        for line in listing:
            mode, owner, _, _, _, path = line.split(maxsplit=5)
            self.assertEqual(owner, "root/root", line)
            expected = ("lrwxrwxrwx" if " -> " in path else
                        "drwxr-xr-x" if mode.startswith("d") else
                        "-rwxr-xr-x" if path == "./usr/bin/gumcert" else "-rw-r--r--")
            self.assertEqual(mode, expected, line)

    def test_keeps_the_customs_of_debian(self):
        for name in ("changelog.gz", "changelog.Debian.gz", "copyright"):
            self.assertTrue((self.doc / name).is_file(), name)
        self.assertEqual(gzip.decompress((self.doc / "changelog.gz").read_bytes()), (ROOT / "CHANGELOG.md").read_bytes())
        entry = gzip.decompress((self.doc / "changelog.Debian.gz").read_bytes()).decode()
        self.assertRegex(entry, r"^gumcert \(\S+-1\) bookworm; urgency=medium\n\n  \* Built from commit \S+\. [^\n]+\n\n"
                                r" -- [^<\n]+ <[^>]+>  \w{3}, \d{2} \w{3} \d{4} \d{2}:\d{2}:\d{2} \+0000\n$")
        commit = re.search(r"^commit (\S+)", run(self.gumcert, "--version"), re.M)[1]
        self.assertIn(f"Built from commit {commit}.", entry)
        self.assertIn("GPL-3", (self.doc / "copyright").read_text(encoding="utf-8"))
        # Whose code is inside the program: every library of which the program needs no shared one.
        inside = {path.name for path in (self.doc / "licences").iterdir()}
        listed = run(ROOT / "scripts/setup", "--list", "build").split()
        needed = run("readelf", "--dynamic", self.gumcert)
        for package in (name for name in listed if name.endswith("-dev")):
            headers = run("dpkg-query", "--listfiles", package).splitlines()
            names = {pathlib.Path(path).name for path in headers if re.search(r"/lib[^/]+\.so$", path)}
            self.assertEqual(package in inside, not any(f"[{name}" in needed for name in names), package)
        # Machine code lies below bin and lib; nothing hidden, and nothing that is for who builds against gumcert.
        for path in self.root.rglob("*"):
            place = path.relative_to(self.root)
            self.assertFalse(any(part.startswith(".") for part in place.parts), place)
            self.assertNotIn("include", place.parts)
            self.assertNotIn(path.suffix, (".a", ".cmake") if "examples" not in place.parts else ())
            if place.is_relative_to("usr/share") and path.is_file():
                self.assertNotEqual(path.read_bytes()[:4], b"\x7fELF", place)
            if path.is_symlink():
                self.assertFalse(os.path.isabs(os.readlink(path)), place)
                self.assertTrue(path.exists(), place)
        for page in (self.root / "usr/share/man/man1").iterdir():
            self.assertEqual(page.suffixes, [".1", ".gz"], page.name)
            # Level 9 and no time of packing, as dh_compress does.
            self.assertEqual(page.read_bytes()[:9], b"\x1f\x8b\x08\x00\x00\x00\x00\x00\x02", page.name)

    def test_remembers_no_folder_of_the_machine_that_built_it(self):
        for path in self.root.rglob("*"):
            if path.is_file() and "node_modules" not in path.parts:
                content = path.read_bytes()
                for folder in (ROOT, GIVEN.build, self.folder):
                    self.assertNotIn(str(folder).encode() + b"/", content, path.relative_to(self.root))
        self.assertNotIn("not stripped", run("file", self.gumcert))

    def test_example_becomes_a_certificate(self):
        job = self.doc / "examples/rotary_table/job.json"
        record = self.folder / "record.json"
        run(self.gumcert, "evaluate", job, "-o", record, environment=self.environment)
        self.assertIn("nothing found", run(self.gumcert, "check", record, environment=self.environment))
        for name in ("certificate.pdf", "chinese.pdf"):
            language = ["--language", "zh-Hant"] if name == "chinese.pdf" else []
            run(self.gumcert, "render", record, "--format", "pdf", "-o", self.folder / name, *language,
                environment=self.environment)
            self.assertTrue((self.folder / name).read_bytes().startswith(b"%PDF-1.7"), name)
        # The same record from the program of the build, which reads the tree.
        run(GIVEN.build / "app/cli/gumcert", "evaluate", job, "-o", self.folder / "of_the_build.json")
        self.assertEqual(record.read_bytes(), (self.folder / "of_the_build.json").read_bytes())

    def test_examples_and_documents_came_whole(self):
        for top in ("examples", "docs"):
            tracked = run("git", "-C", ROOT, "ls-files", "-z", top).split("\0")[:-1] if (ROOT / ".git").exists() else []
            for name in tracked:
                self.assertTrue((self.doc / name).is_file(), name)
            if tracked:
                there = {str(path.relative_to(self.doc)) for path in (self.doc / top).rglob("*") if path.is_file()}
                self.assertEqual(there - set(tracked), set())

    def test_manual_can_be_read(self):
        pages = sorted((self.root / "usr/share/man/man1").iterdir())
        self.assertGreaterEqual(len(pages), 10)
        environment = self.environment | {"MANPATH": str(self.root / "usr/share/man")}
        for page in pages:
            name = page.name.removesuffix(".1.gz")
            self.assertIn(f"{name.upper()}(1)", run("man", name, environment=environment))

    def test_shell_completes(self):
        script = self.root / "usr/share/bash-completion/completions/gumcert"
        replies = run("bash", "--norc", "-c", 'source "$1"; COMP_WORDS=(gumcert re); COMP_CWORD=1; _gumcert; '
                      'echo "${COMPREPLY[@]}"', "bash", script)
        self.assertEqual(replies, "render rerun\n")


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    parser.add_argument("--build", required=True, type=lambda path: pathlib.Path(path).resolve())
    parser.add_argument("--cpack", required=True)
    parser.parse_args(namespace=GIVEN)
    missing = [tool for tool in TOOLS if shutil.which(tool) is None]
    if not (ROOT / "node_modules").is_dir():
        missing.append("the module of package-lock.json")
    if missing:
        print(f"not installed: {', '.join(missing)} — the package is made and tried with them — run scripts/setup")
        sys.exit(77)
    unittest.main(argv=sys.argv[:1])
