"""Reads the places of the sources that make messages: the code of each, the rules that it states, and what it ends in.

A message is made where its code stands: in the braces of a Diagnostic, in the arguments of a function that makes one, or
by a constant that has the code. Texts are read as far as the sources write them; "…" stands for what is known only when
the program runs.
"""

import collections
import pathlib
import re

LAYERS = ("encoding", "gum", "json", "certificate", "laboratory", "engine", "workbook", "audit", "jobs", "reports", "signing", "imports", "archive",
          "outputs", "evaluation", "issuing", "self_test", "app")
CODE = re.compile(r"GC-[A-Z]+-\d{4}")
CLASSES = {"UsageError": "usage", "InputError": "refused", "NoResultError": "no_result", "StorageError": "storage"}
THROWN = re.compile(rf"\b({'|'.join(CLASSES)})\b")
SEVERITY = re.compile(r"(?<!Finding)Severity::(note|warning|error)\b")
# Functions that are told of what is wrong with its place, text and rule; who made them gives all the same code.
CALLBACKS = {"RecordBreach": "GC-RECORD-0017"}
FINDING = re.compile(r'"([A-Z]\d\d(?:-[0-9a-z]+)?)"')

# Comments, strings, characters, numbers (1'000) and words, so that a quote inside one of them is no other one.
TOKEN = re.compile(
    r"""//[^\n]*|/\*.*?\*/|R"([^(\n]*)\(.*?\)\1"|"(?:[^"\\\n]|\\.)*"|'(?:[^'\\\n]|\\.)+'|\d(?:'?[\w.])*|\w+""", re.S)
LITERAL = re.compile(r'R"\((.*?)\)"|"((?:[^"\\\n]|\\.)*)"', re.S)
OPENING, CLOSING = "([{", ")]}"

# file, line: of the code. rules: the texts that the source writes for it, one of them where it chooses. severity, error:
# of the message and the failure, None where the source does not write them there.
Place = collections.namedtuple("Place", "file line rules severity error")


def masked_text(text):
    """The text with its strings and characters blanked, so that brackets and commas can be counted."""
    return TOKEN.sub(
        lambda t: re.sub(r"[^\n]", "\x01", t[0]) if t[0][0] in "\"'" or t[0].startswith('R"') else t[0], text)


def split(text, separators):
    """Parts of a text between separators that stand outside of brackets and strings."""
    parts, depth, begin = [], 0, 0
    for i, c in enumerate(masked_text(text)):
        depth += (c in OPENING) - (c in CLOSING)
        if depth == 0 and c in separators:
            parts.append(text[begin:i].strip())
            begin = i + 1
    return parts + [text[begin:].strip()]


def alternatives(expression):
    """(condition, [A, B]) of `condition ? A : B`, which may go on in B; else (None, [expression])."""
    parts = split(expression.replace("::", "\x02\x02"), "?:")
    parts = [part.replace("\x02\x02", "::") for part in parts]
    return (tuple(parts[0:-1:2]), parts[1::2] + parts[-1:]) if len(parts) > 2 else (None, [expression])


def unwrapped(expression):
    """`text` of `std::move(text)` and `std::string(text)`."""
    wrapped = re.match(r"std::(?:move|string)\((.*)\)$", expression, re.S)
    if not wrapped:
        return expression
    depth = 0
    for c in masked_text(wrapped[1]):
        depth += (c in OPENING) - (c in CLOSING)
        if depth < 0:
            return expression  # a sum that begins with one
    return wrapped[1].strip()


def literal_text(literals):
    """The text of string literals that stand beside each other."""
    return "".join(raw or re.sub(r"\\(.)", lambda m: {"n": "\n", "t": "\t"}.get(m[1], m[1]), text)
                   for raw, text in LITERAL.findall(literals))


class Source:
    def __init__(self, path, name):
        self.name = name
        self.raw = path.read_text(encoding="utf-8")
        self.text = TOKEN.sub(lambda t: re.sub(r"[^\n]", " ", t[0]) if t[0][:2] in ("//", "/*") else t[0], self.raw)
        self.masked = masked_text(self.text)

    def line(self, at):
        return self.text.count("\n", 0, at) + 1

    def opening(self, at):
        """The bracket that `at` stands in; -1 where its statement has none."""
        depth = 0
        for i in range(at - 1, -1, -1):
            c = self.masked[i]
            if c in OPENING and depth == 0:
                return i
            if c == ";" and depth == 0:
                return -1
            depth += (c in CLOSING) - (c in OPENING)
        return -1

    def closing(self, opening):
        depth = 0
        for i in range(opening, len(self.masked)):
            depth += (self.masked[i] in OPENING) - (self.masked[i] in CLOSING)
            if depth == 0:
                return i
        return len(self.masked)

    def inside(self, opening):
        return self.text[opening + 1:self.closing(opening)]

    def function_at(self, at):
        """(name, names of the parameters) of each function around a place, from the inside out."""
        found, depth = [], 0
        for i in range(at - 1, -1, -1):
            c = self.masked[i]
            if c == "{" and depth == 0:
                header = re.search(r"(\w+)\s*(?:=\s*\[[^\[\]]*\]\s*)?\(([^;{}]*)\)[\w\s:>&*-]*$", self.masked[:i])
                if header and header[1] not in ("if", "for", "while", "switch", "catch"):
                    found.append((header[1], parameters(self.text[header.start(2):header.end(2)])))
            depth += (c == "}") - (c == "{")
            depth = max(depth, 0)
        return found


def parameters(text):
    return [re.sub(r"\s*=.*", "", one, flags=re.S).split()[-1].lstrip("&*") if one else "" for one in split(text, ",")]


def defined_in(source, pattern, count):
    found = []
    for m in pattern.finditer(source.masked):
        names = parameters(source.text[m.start(1):m.end(1)])
        if len(names) >= count:
            found.append((len(names), names, source.inside(m.end() - 1)))
    return min(found)[1:] if found else None


class Tree:
    """The sources of the layers and the messages that they make."""

    def __init__(self, root):
        root = pathlib.Path(root)
        self.sources = [
            Source(path, path.relative_to(root).as_posix()) for layer in LAYERS
            for path in sorted([*root.glob(f"{layer}/**/*.h"), *root.glob(f"{layer}/**/*.cpp")])
        ]
        self.places = collections.defaultdict(list)  # code -> [Place]
        self.tables = {}  # code of an InputCode -> names of its constants
        self.literals = collections.defaultdict(list)  # code -> [(file, line)] of literals that are no InputCode
        self.findings = collections.defaultdict(set)  # code -> ids of the findings of a certificate that it becomes
        self.constants = {}  # name of a constant -> its code
        self.texts = {}  # (file, name) of a constant -> its text
        self.helpers = {}  # (file, name, number of arguments) -> what helper() found
        for source in self.sources:
            for name, value in re.findall(r'\b(k_\w+)(?:\[\])?\s*(?:=|\{)\s*((?:(?:R"\([^)]*\)"|"(?:[^"\\\n]|\\.)*")\s*)+)[;}]',
                                          source.text):
                self.texts[source.name, name] = literal_text(value)
        for source in self.sources:
            for found in re.finditer(rf'"[^"\n]*?({CODE.pattern})[^"\n]*"', source.text):
                self.read_literal(source, found.start(), found[1], found[0] == f'"{found[1]}"')
        for source in self.sources:
            for found in re.finditer(r'(?<=\w)\.rule = (?=")', source.text):
                self.read_copy(source, found.end())
        for source in self.sources:
            for found in re.finditer(r"\bk_\w+", source.masked):
                if found[0] in self.constants:
                    self.read_use(source, found.start(), found[0])

        for source in self.sources:
            for kind, code in CALLBACKS.items():
                for name in set(re.findall(rf"\bconst {kind}& (\w+)", source.text)):
                    self.read_calls(source, name, code)

    def read_calls(self, source, name, code):
        """`report(place, what, rule)`."""
        for found in re.finditer(rf"\b{name}\((?!\))", source.masked):
            arguments = split(source.inside(found.end() - 1), ",")
            if len(arguments) == 3 and unwrapped(arguments[2]) != "rule":  # else it hands over what another one says
                self.places[code].append(Place(source.name, source.line(found.start()),
                                               self.rules(source, found.start(), arguments[2], "", ""), None, None))

    def read_literal(self, source, at, code, is_whole):
        before = source.text[max(0, at - 200):at]
        constant = re.search(r"\b(InputCode\s+)?(k_\w+)\s*(?:\{|=)\s*$", before)
        if constant:
            self.constants[constant[2]] = code
            if constant[1]:
                self.tables.setdefault(code, []).append(constant[2])
            return
        if re.search(r"[!=]=\s*$", before):
            return  # asks for a code, makes none
        opening = source.opening(at)
        arguments = split(source.inside(opening), ",") if opening >= 0 else []
        if len(arguments) in (3, 4, 5) and FINDING.fullmatch(arguments[1]):
            self.findings[code].add(FINDING.fullmatch(arguments[1])[1])  # a table from messages to findings
            return
        self.literals[code].append((source.name, source.line(at)))
        if is_whole and opening >= 0:
            self.places[code].append(self.place(source, at, opening, arguments, f'"{code}"'))
        else:
            self.places[code].append(Place(source.name, source.line(at), [], None, None))

    def read_copy(self, source, at):
        """`note.rule = "…";` of a copy of a message: it has the code of the message before it."""
        before = re.findall(rf'"({CODE.pattern})"', source.text[:at])
        if before:
            rule = literal_text(split(source.text[at:at + 2000], ";")[0])
            self.places[before[-1]].append(Place(source.name, source.line(at), [rule], None, None))

    def read_use(self, source, at, name):
        code = self.constants[name]
        after = source.text[at + len(name):at + len(name) + 200]
        if re.match(r'\s*(?:\{|=)\s*"GC-', after) or re.search(r"[!=]=\s*(?:\w+::)*$", source.text[max(0, at - 60):at]):
            return
        opening = source.opening(at)
        if opening >= 0 and re.search(r"\bstd::array k_\w*codes\s*$", source.text[max(0, opening - 60):opening]):
            return  # the list of all codes of a table
        if code in self.tables or opening < 0:
            called = re.search(r"(\w*)\s*$", source.masked[max(0, opening - 60):opening])[1] if opening >= 0 else ""
            severity = {"refuse": "error", "warn": "warning", "note": "note"}.get(called)
            self.places[code].append(Place(source.name, source.line(at), [], severity, None))
        else:
            arguments = split(source.inside(opening), ",")
            self.places[code].append(self.place(source, at, opening, arguments, name))

    def place(self, source, at, opening, arguments, written):
        line = source.line(at)
        code = next((one for one in arguments if written in one), "")
        statement = source.text[max(source.text.rfind(c, 0, opening) for c in ";{}") + 1:opening]
        thrown = THROWN.findall(statement)
        severity = SEVERITY.findall(" ".join(arguments))
        rule, helper_severity, helper_class = None, [], []
        named = [one for one in arguments if re.match(r"\.rule\s*=", one)]
        if named:
            rule = named[0].split("=", 1)[1].strip()
            if rule in ("{}", '""'):
                return Place(source.name, line, [], None, None)  # what becomes a finding and is not told
        elif source.text[opening] == "{" and len(arguments) >= 5:
            rule = arguments[3]
        elif source.text[opening] == "(":
            helper = self.helper(source, re.search(r"(\w*)\s*$", source.masked[max(0, opening - 60):opening])[1],
                                 len(arguments))
            if helper is None:
                return Place(source.name, line, [], severity[0] if severity else None, None)
            names, body = helper
            if "rule" in names and names.index("rule") < len(arguments):
                rule = arguments[names.index("rule")]
            helper_severity, helper_class = set(SEVERITY.findall(body)), set(THROWN.findall(body))
        else:
            return Place(source.name, line, [], None, None)
        if source.text[opening] == "{":
            finding = self.finding_of(source, opening)
            if finding:
                self.findings[self.constants.get(written, written.strip('"'))].add(finding)
        severity = severity or (list(helper_severity) if len(helper_severity) == 1 else [] if helper_severity else ["error"])
        thrown = thrown or (list(helper_class) if len(helper_class) == 1 else [])
        return Place(source.name, line, self.rules(source, at, rule, code, written) if rule else [],
                     severity[0] if len(severity) == 1 else None, CLASSES[thrown[0]] if thrown else None)

    def finding_of(self, source, opening):
        """The id of the finding that a message becomes: `.message = {…}, .id = "A01"`."""
        if not re.search(r"\.message\s*=\s*(?:\w+::)*\w*\s*$", source.text[max(0, opening - 60):opening]):
            return None
        outer = source.opening(opening)
        ids = [one for one in split(source.inside(outer), ",") if re.match(r"\.id\s*=", one)] if outer >= 0 else []
        return FINDING.search(ids[0])[1] if ids and FINDING.search(ids[0]) else None

    def helper(self, source, name, count):
        """Names of the parameters and the body of the function that makes a message of so many arguments: of this file,
        its folder, or the one that all of `gum` uses."""
        key = (source.name, name, count)
        if key not in self.helpers:
            folder = source.name.rsplit("/", 1)[0]
            others = [one for one in self.sources if one is not source and one.name.rsplit("/", 1)[0] == folder]
            shared = [one for one in self.sources if one.name == "gum/argument_check.cpp"]
            pattern = re.compile(rf"\b{name}\s*(?:=\s*\[[^\]]*\]\s*)?\(([^;{{}}]*?\bcode\b[^;{{}}]*?)\)[^;{{}}()]*\{{")
            self.helpers[key] = next(
                (found for one in [source, *others, *shared] if name and (found := defined_in(one, pattern, count))), None)
        return self.helpers[key]

    def rules(self, source, at, expression, code, written):
        conditions, choices = alternatives(expression)
        asked, codes = alternatives(code.split("=", 1)[1].strip() if code.startswith(".code") else code)
        if conditions and conditions == asked:
            choices = [choice for choice, one in zip(choices, codes) if written in one]
        texts = [text for choice in choices for text in self.texts_of(source, at, choice)]
        return [text for text in dict.fromkeys(texts) if re.search(r"\w", text)]

    def texts_of(self, source, at, expression, depth=0):
        """The texts that an expression can have. A name is looked up: a constant, a variable of the function, or a
        parameter, which has the texts that the callers in this file give it."""
        expression = unwrapped(expression)
        name = re.fullmatch(r"\w+", expression)
        if name and depth < 3:
            if (source.name, expression) in self.texts:
                return [self.texts[source.name, expression]]
            for function, names in source.function_at(at)[:2]:
                if expression in names:
                    return self.texts_of_callers(source, function, names, expression, depth)
            start = max((m.end() for m in re.finditer(rf"\b{expression}\s*=(?!=)\s*", source.text[:at])), default=-1)
            if start >= 0:
                value = source.text[start:start + 2000]
                value = split(value, ";")[0]
                return [text for choice in alternatives(value)[1] for text in self.texts_of(source, start, choice, depth + 1)]
            return ["…"]
        pieces = []
        for part in split(expression, "+"):
            part = unwrapped(part)
            literal = re.fullmatch(r'(?:(?:R"\([^)]*\)"|"(?:[^"\\\n]|\\.)*")\s*)+', part)
            pieces.append(literal_text(part) if literal else self.texts.get((source.name, part), "…"))
        return [re.sub(r"…+", "…", "".join(pieces))]

    def texts_of_callers(self, source, function, names, parameter, depth):
        texts = []
        for m in re.finditer(rf"\b{function}\s*\(", source.masked):
            arguments = split(source.inside(m.end() - 1), ",")
            closing = source.closing(m.end() - 1)
            if re.match(r"[\w\s]*\{", source.masked[closing + 1:closing + 40]) and re.search(
                    r"[\w>&*\]]\s*$", source.masked[:m.start()]) and not re.search(r"\breturn\s*$", source.masked[:m.start()]):
                continue  # the function itself
            at = names.index(parameter)
            if len(arguments) > at:
                for choice in alternatives(arguments[at])[1]:
                    texts += self.texts_of(source, m.start(), choice, depth + 1)
        return texts or ["…"]
