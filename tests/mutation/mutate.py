"""Small changes of a C++ source, as a slip of the writer would make them: where they are possible, and the source with one of them."""

import dataclasses
import re

# Comments, texts and lines of the preprocessor are passed over as a whole; what is left is looked at word by word.
PASSED_OVER = re.compile(r'//[^\n]*|/\*.*?\*/|R"(\w*)\(.*?\)\1"|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])+\'|^[ \t]*#[^\n]*', re.S | re.M)

# Operators stand between spaces in our sources, and those of templates, pointers and references do not.
OPERATORS = {
    " < ": [" <= "], " <= ": [" < "], " > ": [" >= "], " >= ": [" > "], " == ": [" != "], " != ": [" == "],
    " + ": [" - "], " - ": [" + "], " * ": [" / "], " / ": [" * "], " += ": [" -= "], " -= ": [" += "], " *= ": [" /= "],
    " && ": [" || "], " || ": [" && "], "++": ["--"],
}
WORDS = {"std::min": "std::max", "std::max": "std::min", "std::sqrt": "", "std::abs": "", "true": "false", "false": "true"}
OPERATOR = re.compile("|".join(re.escape(word) for word in sorted(OPERATORS, key=len, reverse=True)))
WORD = re.compile(r"(?<![\w:])(?:" + "|".join(WORDS) + r")(?![\w:])")
NUMBER = re.compile(r"(?<![\w.:])(?:\d+\.\d*(?:[eE][-+]?\d+)?|\d+[eE][-+]?\d+|\d+)(?![\w.])")
SIGN = re.compile(r"(?<=[=(,]) ?-(?=[A-Za-z_(])|(?<=return )-(?=[A-Za-z_(])")
CONDITION = re.compile(r"\bif \((?!const|auto|std::optional|!)")


@dataclasses.dataclass(frozen=True)
class Mutant:
    """A change of the characters begin to end of a source."""

    begin: int
    end: int
    new: str
    line: int
    what: str  # "x <= y: < for <="


def blanked(text):
    """The source with everything that is passed over as blanks, of the same length."""
    return PASSED_OVER.sub(lambda found: re.sub(r"[^\n]", " ", found[0]), text)


def other_number(text):
    """Another number of the same kind: 0 is 1, others are one more or half as large again."""
    if re.fullmatch(r"\d+", text):
        return str(int(text) + 1)
    value = float(text)
    return repr(1.0 if value == 0.0 else 1.5 * value)


def matching(text, begin):
    """Behind the bracket that closes the one at begin."""
    depth = 0
    for at in range(begin, len(text)):
        depth += (text[at] == "(") - (text[at] == ")")
        if depth == 0:
            return at + 1
    return None


def is_declaration(code, at):
    """Whether the line of a number only declares how long an array or a type is."""
    return code[max(0, at - 1)] in "[<" or re.search(r"\b(?:case|static_assert|alignas)\b", code[code.rfind("\n", 0, at) + 1 : at])


def mutants_of(text):
    """All changes of a source, in the order of their places."""
    code = blanked(text)
    found = []

    def add(begin, end, new, what):
        found.append(Mutant(begin, end, new, text.count("\n", 0, begin) + 1, what))

    for match in OPERATOR.finditer(code):
        for new in OPERATORS[match[0]]:
            add(match.start(), match.end(), new, f"{new.strip()} for {match[0].strip()}")
    for match in WORD.finditer(code):
        new = WORDS[match[0]]
        add(match.start(), match.end(), new, f"{new or 'nothing'} for {match[0]}")
    for match in NUMBER.finditer(code):
        if not is_declaration(code, match.start()):
            new = other_number(match[0])
            add(match.start(), match.end(), new, f"{new} for {match[0]}")
    for match in SIGN.finditer(code):
        add(match.start(), match.end(), " ", "+ for the sign -")
    for match in CONDITION.finditer(code):
        begin = match.end() - 1
        end = matching(code, begin)
        if end and ";" not in code[begin:end]:
            add(begin, end, "(!" + text[begin:end] + ")", "the opposite of the condition")
    return sorted(found, key=lambda mutant: (mutant.begin, mutant.what))


def applied(text, mutant):
    return text[: mutant.begin] + mutant.new + text[mutant.end :]
