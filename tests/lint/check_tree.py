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
- a public header of the domain that declares functions without a unit test of its name in the mirrored folder:
  gum/a.h has tests/unit/gum/a_test.cpp. Structs, constants, macros and templates are no functions here. Around the domain
  the headers without one are listed in tests/lint/untested_headers.txt: a new header is not, and one that has its test is
  taken off
- a handler of std::exception, in a layer that reads files, without one of std::bad_alloc before it: memory that ends says nothing
  of the file that is read, and is told as such
- a count with a plural behind it in what the program tells, and in refusals of its readers ("1 certificates"): text::count_of() knows
  both forms; "1 of 3 records" stands as it is, and so does a limit
- a layer of more than 25 units (a header with its source): it has more than one subject, and is to be divided by them
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
DOMAIN = {"text", "encoding", "system", "json", "gum", "engine", "certificate", "laboratory", "archive", "workbook",
          "audit"}  # layers, with those below them
AROUND_DOMAIN = {"jobs", "reports", "imports", "signing", "outputs", "evaluation", "issuing", "self_test", "manual", "app"}
UNTESTED_AROUND_DOMAIN = "tests/lint/untested_headers.txt"
LAYERS = "cmake/gumcert_layers.cmake"
MOST_UNITS = 25
UNTESTED_BY_NAME = {}  # a header of the domain, and the reason why its functions have no test by its name
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


HANDLER = re.compile(r"\}\s*catch \(([^)]*)\) \{")
READERS = ("app/", "archive/", "evaluation/", "imports/", "issuing/", "json/", "outputs/", "reports/", "self_test/", "signing/", "workbook/")
TOLD_ABOVE = ("app/cli/",)  # programs, which tell what comes to them


def handlers_that_blame_a_file(name, text):
    """Lines of handlers of std::exception that take the end of the memory for a fault of what is read."""
    if not name.startswith(READERS) or name.startswith(TOLD_ABOVE) or not name.endswith(".cpp"):
        return
    lines = text.split("\n")
    of_try = {}  # by the indentation of their try
    for number, line in enumerate(lines, start=1):
        indentation = len(line) - len(line.lstrip())
        if re.match(r"\s*try \{|.*\btry \{$", line):
            of_try[indentation] = set()
        caught = HANDLER.search(line)
        if caught:
            handlers = of_try.setdefault(indentation, set())
            if caught[1].startswith("const std::exception&") and not any("bad_alloc" in one for one in handlers):
                yield number
            handlers.add(caught[1])


# Folders whose lines people read on a terminal, with those whose refusals stand there.
TOLD_ON_A_TERMINAL = ("app/", "archive/", "engine/curve_fit", "evaluation/", "gum/", "imports/", "issuing/", "jobs/", "json/",
                      "laboratory/", "outputs/", "reports/summary/", "self_test/", "signing/", "workbook/")
ONE_OF_MANY = re.compile(r'of (?:"\s*\+\s*)?$')
# A limit of the program is more than one, and so is what is told because it is above a limit.
LIMIT = re.compile(r"to_string\((?:k_|limits\.|size\.most|options_\.|most_|deepest_|adaptive\.most_|least\b|3 \*)")
SQUARE = re.compile(r'\s*and columns\b')  # "2 rows and columns" of a matrix
COUNTED = re.compile(r"""\{\}\ (?:more\ |other\ |earlier\ )?(?P<a>[a-z]{3,}s)\b
                       |to_string\((?:[^()"]|\((?:[^()]|\([^()]*\))*\))*\)\s*\+\s*"\ (?:more\ |other\ |earlier\ )?(?P<b>[a-z]{3,}s)\b""", re.VERBOSE)
NO_PLURAL = {"agrees", "belongs", "breaks", "bytes", "does", "has", "names", "this"}  # verbs, and units of limits
ALWAYS_SEVERAL = {("evaluation/kinds.cpp", "results"), ("reports/summary/record_summary.cpp", "trials"),
                  ("archive/certificates/archive_statistics.cpp", "readings"), ("self_test/case_formula.cpp", "numbers"),
                  ("self_test/case_formula.cpp", "parentheses"), ("self_test/case_run.cpp", "numbers")}


def counts_with_a_plural(name, text):
    """Lines with a number and a noun behind it that has no other form for one."""
    if not name.startswith(TOLD_ON_A_TERMINAL) or not name.endswith(".cpp"):
        return
    for found in COUNTED.finditer(text):
        noun = found["a"] or found["b"]
        before = re.sub(r"std::$", "", text[:found.start()])
        is_plain = LIMIT.match(found[0]) or SQUARE.match(text[found.end():])
        if noun not in NO_PLURAL and not is_plain and not ONE_OF_MANY.search(before) and (name, noun) not in ALWAYS_SEVERAL:
            yield text.count("\n", 0, found.start()) + 1, noun


def without_comments(text):
    text = re.sub(r"/\*.*?\*/|//[^\n]*", "", text, flags=re.DOTALL)
    text = re.sub(r"^[ \t]*#(?:[^\n\\]|\\\n|\\.)*", "", text, flags=re.MULTILINE)  # and without the preprocessor
    return re.sub(r'"(?:[^"\\\n]|\\.)*"', '""', text)


def functions_declared(text):
    """Whether a header declares functions: free ones, or members of a class or struct that are defined in its source."""
    scopes, statement = [], ""
    for character in without_comments(text):
        if character not in "{};":
            statement += character
            continue
        words = " ".join(statement.split())
        statement = ""
        if character == "}":
            if scopes:
                scopes.pop()
            continue
        is_template = words.startswith("template")
        head = re.sub(r"^(?:(?:public|protected|private) ?: ?)+", "", words)
        opened = "body"
        if re.match(r"(?:inline )?namespace\b", head):
            opened = "namespace"
        elif re.match(r"(?:class|struct|enum|union)\b", head):
            opened = "type"
        elif not {"body", "template"}.intersection(scopes) and not is_template and "(" in head:
            member = "type" in scopes
            before = head[:head.index("(")]
            # A bracket inside of < > belongs to the type of a member, as in std::function<double(double)>.
            is_type = before.count("<") > before.count(">")
            declares = "=" not in before and not is_type and not re.match(r"(?:using|typedef|friend|static_assert)\b", head)
            defaulted = re.search(r"= ?(?:default|delete|0)$", head)
            # A member that is written out in the header belongs to its struct.
            if declares and not defaulted and not (member and character == "{"):
                return True
        if character == "{":
            scopes.append("template" if is_template else opened)
    return False


def headers_without_tests(root, files):
    names = {path.relative_to(root).as_posix() for path in files}
    listed = re.search(r"set\(GUMCERT_PRIVATE_HEADERS([^)]*)\)", (root / LAYERS).read_text(encoding="utf-8")) \
        if LAYERS in names else None
    private = set(listed[1].split()) if listed else set()
    known = set((root / UNTESTED_AROUND_DOMAIN).read_text(encoding="utf-8").split()) \
        if UNTESTED_AROUND_DOMAIN in names else set()
    for name in sorted(known - names):
        yield name, f"is not there any more; take it off {UNTESTED_AROUND_DOMAIN}"
    for name in sorted(names):
        layer = name.split("/")[0]
        if not name.endswith(".h") or layer not in DOMAIN | AROUND_DOMAIN or name in private:
            continue
        test = f"tests/unit/{name[:-2]}_test.cpp"
        has_functions = functions_declared((root / name).read_text(encoding="utf-8"))
        if has_functions and test not in names and name not in UNTESTED_BY_NAME and name not in known:
            yield name, f"declares functions, and there is no {test}"
        if name in known and (test in names or not has_functions or layer in DOMAIN):
            yield name, f"needs no reason for its missing test any more; take it off {UNTESTED_AROUND_DOMAIN}"
        if name in UNTESTED_BY_NAME and (test in names or not has_functions):
            yield name, "needs no reason for its missing test any more; take it off UNTESTED_BY_NAME"


def full_layers(root, files):
    """Layers that have more units than one looks through."""
    listed = re.search(r"set\(GUMCERT_LAYER_FOLDERS([^)]*)\)", (root / LAYERS).read_text(encoding="utf-8")) \
        if (root / LAYERS).exists() else None
    for layer in listed[1].split() if listed else ():
        units = {path.stem for path in files if path.parent == root / layer and path.suffix in {".h", ".cpp"}}
        if len(units) > MOST_UNITS:
            yield layer, f"{len(units)} units; a layer has at most {MOST_UNITS}: divide it by subject (docs/adr/0045-rooms.md)"


def main(arguments):
    root = pathlib.Path(arguments[0] if arguments else ".").resolve()
    files = files_of(root)
    found = 0
    for path in files:
        for number, reason in breaches(path):
            print(f"{path.relative_to(root).as_posix()}:{number}: {reason}")
            found += 1
        name = path.relative_to(root).as_posix()
        for number in handlers_that_blame_a_file(name, path.read_text(encoding="utf-8") if path.suffix == ".cpp" else ""):
            print(f"{name}:{number}: takes the end of the memory for a fault of the file; let std::bad_alloc through before")
            found += 1
        for number, noun in counts_with_a_plural(name, path.read_text(encoding="utf-8") if path.suffix == ".cpp" else ""):
            print(f"{name}:{number}: \"{noun}\" behind a count that may be 1; use text::count_of()")
            found += 1
    for layer, reason in full_layers(root, files):
        print(f"{layer}: {reason}")
        found += 1
    for name, reason in headers_without_tests(root, files):
        print(f"{name}:1: {reason}")
        found += 1
    if not files:
        print(f"{root}: no file found to check")
        return 1
    print(f"{len(files)} files checked, {found} breaches")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
