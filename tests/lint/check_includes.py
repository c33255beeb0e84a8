#!/usr/bin/env python3
"""Who includes whom, checked against the tables of cmake/gumcert_layers.cmake.

    check_includes.py [ROOT] [--no-spare-permissions]

Prints `path:line: reason` for every breach and exits with 1, or 0 when there is none. A file belongs to the layer with
the longest folder prefix. Five laws, and with the option a sixth:

1. An #include of ours names a layer in the list of the file's layer; one from outside is in its list of third-party
   headers, or in the C++ standard library.
2. What GUMCERT_NOT_IN_HEADERS names never stands in a header, GUMCERT_PRIVATE_HEADERS excepted; and those are
   included by their own layer only. What GUMCERT_ONLY_IN names stands in its one header only.
3. Only the layers of GUMCERT_MAY_TOUCH_FILES include <fstream> or <filesystem>.
4. Libraries never print, exit, or read the clock, the locale or the environment: only the program (app/cli) does.
   Numbers are read and printed without the locale: std::from_chars and std::to_chars.
5. The table of docs/architecture.md, which people read, names for each layer those of the list and no others.
6. A permission of the tables that no file of its layer uses is taken back: it would let in what nobody decided.
"""

import pathlib
import re
import sys

PROGRAM_LAYERS = ("app/cli", "app/cli/archive", "app/cli/terminal")

LAW = "cmake/gumcert_layers.cmake"
DOCUMENT = "docs/architecture.md"
ROW = re.compile(r"^\| `([\w/]+)` \| (.*?) \| .*? \|$", re.M)  # a layer, those that it uses, packages

FILE_HEADERS = ("fstream", "filesystem")

# C++ headers that a library has no use for, with the reason.
REFUSED_HEADERS = {
    "iostream": "libraries never print",
    "cstdio": "libraries never print; format with std::to_chars or fmt",
    "stdio.h": "libraries never print; format with std::to_chars or fmt",
    "clocale": "libraries never touch the locale",
    "locale.h": "libraries never touch the locale",
    "locale": "libraries never touch the locale",
}

REFUSED_CALLS = [
    (r"\bstd\s*::\s*(?:w?cout|w?cerr|w?clog)\b", "libraries never print"),
    (r"\b(?:f|s|sn|v|vf|vsn|d)?printf\s*\(", "libraries never print, and printf follows the locale"),
    (r"\bf?puts\s*\(|\bfputc\s*\(|\bputchar\s*\(|\bperror\s*\(", "libraries never print"),
    (r"(?<![\w.>])(?:std\s*::\s*|::\s*)?(?:exit|_exit|_Exit|quick_exit|abort|terminate)\s*\(", "libraries never end the program"),
    (r"\b(?:secure_)?getenv\s*\(|\bsetenv\s*\(|\bputenv\s*\(", "libraries never read the environment"),
    (r"\bsetlocale\s*\(|\bstd\s*::\s*locale\b|\bimbue\s*\(", "libraries never touch the locale"),
    (r"\b(?:strto(?:d|f|ld|l|ul|ll|ull)|ato[fil]|atoll|sscanf)\s*\(", "reads by the locale; use std::from_chars"),
    (r"\b(?:std\s*::\s*)?sto(?:d|f|ld|i|l|ll|ul|ull)\s*\(", "reads by the locale; use std::from_chars"),
    (r"\bstd\s*::\s*to_string\s*\(\s*[\w.]*\d+\.\d", "prints by the locale; use std::to_chars"),
    (r"\b(?:system_clock|high_resolution_clock|utc_clock)\s*::\s*now\b", "libraries never read the clock"),
    (r"(?<![\w.>])(?:std\s*::\s*|::\s*)?(?:time|clock|gettimeofday|clock_gettime)\s*\(\s*(?:\)|NULL|nullptr|0\s*\)|&|CLOCK_)",
     "libraries never read the clock"),
]
# Layers that compute have no use for waiting either; the others may set a time limit.
STEADY_CLOCK = re.compile(r"\bsteady_clock\b")
REFUSED_CALLS = [(re.compile(pattern), reason) for pattern, reason in REFUSED_CALLS]

# Comments and literals, longest first; a quote after a digit or letter is a digit separator or a suffix, not a literal.
NOT_CODE = re.compile(
    r'//[^\n]*|/\*.*?\*/|R"(?P<mark>[^(\s]*)\(.*?\)(?P=mark)"|"(?:\\.|[^"\\\n])*"|(?<!\w)\'(?:\\.|[^\'\\\n])+\'', re.S)
INCLUDE = re.compile(r'^[ \t]*#[ \t]*include[ \t]*(?P<form>[<"])(?P<name>[^>"\n]+)[>"]', re.M)


class Law:
    """The tables, as cmake/gumcert_layers.cmake states them."""

    def __init__(self, root):
        text = (root / LAW).read_text(encoding="utf-8")
        text = re.sub(r"#[^\n]*", "", text)
        tables = {name: words.split() for name, words in re.findall(r"^set\(GUMCERT_(\w+)([^)]*)\)", text, re.M)}
        self.layers = tables.get("LAYER_FOLDERS", [])
        self.not_in_headers = tables["NOT_IN_HEADERS"]
        self.may_touch_files = tables["MAY_TOUCH_FILES"]
        self.private_headers = set(tables["PRIVATE_HEADERS"])
        self.one_header, *self.only_there = tables["ONLY_IN"]
        if not self.layers:
            raise SystemExit(f"{LAW}: no GUMCERT_LAYER_FOLDERS found — the scanner reads its law there")
        self.edges = {layer: tables["EDGES_" + layer.replace("/", "_")] for layer in self.layers}
        self.third_party = {layer: tables["THIRD_PARTY_" + layer.replace("/", "_")] for layer in self.layers}
        self.used = set()  # (layer, word) of each permission that an #include needed

    def spare_permissions(self):
        """A sentence for each permission that no #include needed."""
        for layer in self.layers:
            for table, words in (("EDGES", self.edges), ("THIRD_PARTY", self.third_party)):
                for word in words[layer]:
                    if (layer, word) not in self.used:
                        yield f"GUMCERT_{table}_{layer.replace('/', '_')}: no file of {layer} includes {word}"
        for layer in self.may_touch_files:
            if not any((layer, header) in self.used for header in FILE_HEADERS):
                yield f"GUMCERT_MAY_TOUCH_FILES: no file of {layer} includes {' or '.join(FILE_HEADERS)}"

    def layer_of(self, path):
        """The layer with the longest folder prefix of a path relative to the root, or None."""
        fitting = [layer for layer in self.layers if path.startswith(layer + "/")]
        return max(fitting, key=len, default=None)


def differences_of_document(root, law):
    """(line, reason) where the table of the document says something else than the law."""
    text = (root / DOCUMENT).read_text(encoding="utf-8") if (root / DOCUMENT).is_file() else ""
    listed = set()
    for row in ROW.finditer(text):
        layer, named = row[1], set(re.findall(r"`([\w/]+)`", row[2]))
        listed.add(layer)
        line = text.count("\n", 0, row.start()) + 1
        for word in sorted(named.symmetric_difference(law.edges.get(layer, ()))):
            yield line, f"{layer} {'does not use' if word in named else 'uses'} {word}, as {LAW} says"
        if layer not in law.edges:
            yield line, f"{layer} is no layer of {LAW}"
    for layer in law.layers:
        if layer not in listed:
            yield 1, f"the table has no row of {layer}"


def in_list(header, entries):
    return any(header == entry or header.startswith(entry + "/") for entry in entries)


def blank(match):
    return re.sub(r"[^\n]", " ", match.group())


def breaches(root, path, layer, law):
    """(line, reason) of each breach in one file."""
    text = (root / path).read_text(encoding="utf-8")
    # Includes are read from the text without comments, calls from the text without literals as well.
    without_comments = NOT_CODE.sub(lambda m: blank(m) if m.group().startswith("/") else m.group(), text)
    code = NOT_CODE.sub(blank, text)

    def line(position):
        return text.count("\n", 0, position) + 1

    for include in INCLUDE.finditer(without_comments):
        name, at = include["name"], line(include.start())
        used = law.layer_of(name)
        if used is not None:
            law.used.add((layer, used))
            if include["form"] != '"':
                yield at, f'<{name}> is ours — own headers are included as "{name}"'
            if used != layer and used not in law.edges[layer]:
                yield at, f"{layer} includes {name} of {used} — allowed are: {', '.join(law.edges[layer]) or 'none'}"
            if name in law.private_headers and used != layer:
                yield at, f"{name} is private to {used}"
            if not (root / name).is_file():
                yield at, f"{name} does not exist"
            continue
        if include["form"] == '"':
            yield at, f'"{name}" is in no layer — own headers are included from the root of the tree, others with <>'
            continue
        standard = "/" not in name and "." not in name
        law.used.update((layer, word) for word in [*law.third_party[layer], *FILE_HEADERS] if in_list(name, [word]))
        if not standard and not in_list(name, law.third_party[layer]):
            yield at, f"<{name}> is not among the third-party headers of {layer}: {', '.join(law.third_party[layer])}"
        if path.endswith(".h") and path not in law.private_headers and in_list(name, law.not_in_headers):
            yield at, f"<{name}> stands in a header — keep it in a .cpp, behind the layer's own types"
        if name in law.only_there and path != law.one_header:
            yield at, f"<{name}> — include {law.one_header} in its place: what it brings is compiled once"
        if name in FILE_HEADERS and layer not in law.may_touch_files:
            yield at, f"<{name}> — {layer} does not touch files"
        if layer not in PROGRAM_LAYERS and name in REFUSED_HEADERS:
            yield at, f"<{name}> — {REFUSED_HEADERS[name]}"
    if layer not in law.may_touch_files:
        for clock in STEADY_CLOCK.finditer(code):
            yield line(clock.start()), f"steady_clock — {layer} does not wait for anything"
    if layer not in PROGRAM_LAYERS:
        for pattern, reason in REFUSED_CALLS:
            for call in pattern.finditer(code):
                yield line(call.start()), f"{' '.join(call.group().split())} — {reason}"


def main(arguments):
    no_spare_permissions = "--no-spare-permissions" in arguments
    roots = [argument for argument in arguments if not argument.startswith("--")]
    root = pathlib.Path(roots[0] if roots else ".").resolve()
    law = Law(root)
    found = checked = 0
    for top in sorted({layer.split("/")[0] for layer in law.layers}):
        for file in sorted((root / top).rglob("*")):
            if file.suffix not in (".h", ".cpp"):
                continue
            path = file.relative_to(root).as_posix()
            checked += 1
            layer = law.layer_of(path)
            if layer is None:
                reasons = [(1, f"in no layer — the layers are {', '.join(law.layers)}")]
            elif str(pathlib.PurePosixPath(path).parent) != layer:
                reasons = [(1, f"lies in a folder below {layer} that the build does not read")]
            else:
                reasons = sorted(set(breaches(root, path, layer, law)))
            for line, reason in reasons:
                print(f"{path}:{line}: {reason}")
                found += 1
    for line, reason in differences_of_document(root, law):
        print(f"{DOCUMENT}:{line}: {reason}")
        found += 1
    for reason in law.spare_permissions() if no_spare_permissions else ():
        print(f"{LAW}: {reason} — take the word out of the table")
        found += 1
    if checked == 0:
        print(f"{root}: no source found to check")
        return 1
    print(f"{checked} files checked, {found} breaches")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
