#!/usr/bin/env python3
"""What may not stand in any file of the tree.

    check_tree.py [ROOT]

Prints `path:line: reason` for every breach and exits with 1, or 0 when there is none. Looks at the files that git
knows or would add; in a tree without git, at every file outside build folders.

- paths of one machine (a home folder), which work for nobody else
- addresses of package registries: which one is used is the business of the machine that installs
- open ends in sources without the number of an issue
- links of a document to a file of the tree that is not there
- conflict marks, and line ends of another system in sources
- a doc tag (\\param, \\return, \\throws) inside a line of text: each has a line of its own
"""

import pathlib
import re
import subprocess
import sys

SOURCES = {".h", ".cpp", ".cmake", ".py", ".sh", ".mjs", ".js", ".typ", ".mustache", ".css", ".json", ".md"}
OPEN_ENDS_ALLOWED = {".md", ".json"}  # prose and data speak about them

MACHINE_PATH = re.compile(r"(?<![\w.:/-])/(?:home/\w|root/|work/|Users/\w|var/folders/)|\b[A-Z]:\\{1,2}Users\\")
REGISTRY = re.compile(
    r"(?i)\bhttps?://[^\s\"'>)]*(?:registry|artifactory|nexus|mirror|proxy|pypi|deb\.debian|ftp\.debian|apt\.)[^\s\"'>)]*"
    r"|\"resolved\"\s*:\s*\"https?:|^\s*registry\s*=\s*http")
OPEN_END = re.compile(r"\b(?:TO" r"DO|FIX" r"ME|X" r"XX)\b(?!\s*\(?#\d+)")
LINK = re.compile(r"\]\((?!https?:|mailto:|#)([^)#\s]+)")
CONFLICT = re.compile(r"^(?:<{7}|>{7}) ")
TAG_IN_TEXT = re.compile(r"^\s*///.*[^\s/].*\s\\(?:param|return|throws)\b")


def files_of(root):
    listed = subprocess.run(["git", "-C", str(root), "ls-files", "-z", "--cached", "--others", "--exclude-standard"],
                            capture_output=True, check=False) if (root / ".git").exists() else None
    if listed is not None and listed.returncode == 0:
        paths = {root / name for name in listed.stdout.decode("utf-8").split("\0") if name}
    else:
        skipped = {"build", "node_modules", "__pycache__", ".git"}
        paths = {path for path in root.rglob("*") if not skipped.intersection(path.relative_to(root).parts)}
    return sorted(path for path in paths if path.is_file())


def breaches(path):
    data = path.read_bytes()
    if b"\0" in data[:8192]:
        return
    text = data.decode("utf-8", errors="replace")
    is_source = path.suffix in SOURCES or path.name == "CMakeLists.txt" or text.startswith("#!")
    for number, line in enumerate(text.split("\n"), start=1):
        machine = MACHINE_PATH.search(line)
        if machine:
            yield number, f"{machine.group()}… — a path of one machine; use a path relative to the tree"
        registry = REGISTRY.search(line)
        if registry:
            yield number, f"{registry.group().strip()} — the address of a package registry; leave it to the machine's settings"
        if is_source and path.suffix not in OPEN_ENDS_ALLOWED and OPEN_END.search(line):
            yield number, f"{OPEN_END.search(line).group()} without the number of an issue"
        if path.suffix in {".h", ".cpp"} and TAG_IN_TEXT.search(line):
            yield number, "a doc tag inside a line of text; give it a line of its own"
        if is_source and line.endswith("\r"):
            yield number, "line ends with CR LF; sources end lines with LF"
        for link in LINK.finditer(line) if path.suffix == ".md" else ():
            if not (path.parent / link[1]).exists():
                yield number, f"links to {link[1]}, which does not exist"
        if CONFLICT.match(line):
            yield number, "conflict mark of a merge"


def main(arguments):
    root = pathlib.Path(arguments[0] if arguments else ".").resolve()
    files = files_of(root)
    found = 0
    for path in files:
        for number, reason in breaches(path):
            print(f"{path.relative_to(root).as_posix()}:{number}: {reason}")
            found += 1
    if not files:
        print(f"{root}: no file found to check")
        return 1
    print(f"{len(files)} files checked, {found} breaches")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
