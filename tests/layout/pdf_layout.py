"""What is wrong with the layout of a PDF that the certificate template set, seen without a person.

Boxes of words come from pdftotext of poppler, tables and headings from the tags of the PDF (PDF/A-3a has them all), read by
qpdf. All lengths in points, from the upper left corner of the page.
"""

import json
import subprocess
import unicodedata
import xml.etree.ElementTree
from dataclasses import dataclass, field
from pathlib import Path

MILLIMETRE = 72 / 25.4
LEFT, RIGHT, TOP, BOTTOM = 20 * MILLIMETRE, 18 * MILLIMETRE, 22 * MILLIMETRE, 20 * MILLIMETRE  # as in certificate.typ
SLACK = 1.0  # what hangs over an edge by less is not seen
LEAST_FILLED = 0.3  # of the height of the text area, on every page but the last
LEAST_LAST_LINES = 7  # what the verdicts mean, and the end, with rows of the table before them
XHTML = "{http://www.w3.org/1999/xhtml}"


@dataclass
class Word:
    text: str
    left: float
    top: float
    right: float
    bottom: float

    def overlaps(self, other: "Word") -> bool:
        """The boxes are as high as the font, more than the letters: lines may touch, and indices reach into their line."""
        across = min(self.right, other.right) - max(self.left, other.left)
        down = min(self.bottom, other.bottom) - max(self.top, other.top)
        narrower = min(self.right - self.left, other.right - other.left)
        lower = min(self.bottom - self.top, other.bottom - other.top)
        return across > max(SLACK, 0.1 * narrower) and down > 0.4 * lower


@dataclass
class Page:
    width: float
    height: float
    words: list[Word] = field(default_factory=list)
    blocks: list[list[list[str]]] = field(default_factory=list)  # the words of the lines of each block

    def body(self) -> list[Word]:
        """Without head and foot."""
        return [w for w in self.words if w.bottom > TOP + SLACK and w.top < self.height - BOTTOM - SLACK]


@dataclass
class Element:
    """An element of the tags with its pages, numbered from 1."""
    kind: str
    pages: set[int]
    parts: list["Element"]


def pages_of(pdf: Path) -> list[Page]:
    text = subprocess.run(["pdftotext", "-bbox-layout", str(pdf), "-"], capture_output=True, check=True).stdout
    pages = []
    for found in xml.etree.ElementTree.fromstring(text).iter(XHTML + "page"):
        page = Page(float(found.get("width")), float(found.get("height")))
        for word in found.iter(XHTML + "word"):
            box = [float(word.get(name)) for name in ("xMin", "yMin", "xMax", "yMax")]
            page.words.append(Word(word.text or "", *box))
        for block in found.iter(XHTML + "block"):
            page.blocks.append([[word.text or "" for word in line.iter(XHTML + "word")] for line in block.iter(XHTML + "line")])
        pages.append(page)
    return pages


def tags_of(pdf: Path) -> Element:
    told = subprocess.run(["qpdf", "--json=2", "--json-key=qpdf", "--json-key=pages", "--json-stream-data=none", str(pdf)],
                          capture_output=True, check=True).stdout
    document = json.loads(told)
    objects = {name.removeprefix("obj:"): o.get("value", {}) for name, o in document["qpdf"][1].items()
               if name.startswith("obj:")}
    page_numbers = {page["object"]: i + 1 for i, page in enumerate(document["pages"])}

    def followed(value):
        while isinstance(value, str) and value in objects:
            value = objects[value]
        return value

    def element(value, page: int) -> Element:
        node = followed(value)
        if isinstance(node, int):
            return Element("content", {page}, [])
        page = page_numbers.get(node.get("/Pg"), page)
        if "/S" not in node and "/K" not in node:
            return Element("content", {page} if "/MCID" in node else set(), [])
        kids = followed(node.get("/K", []))
        parts = [element(kid, page) for kid in (kids if isinstance(kids, list) else [kids])]
        return Element(node.get("/S", "").removeprefix("/"), set().union(*(part.pages for part in parts)), parts)

    root = next(followed(o["/StructTreeRoot"]) for o in objects.values()
                if isinstance(o, dict) and o.get("/Type") == "/Catalog")
    return element(root, 0)


def all_of(tags: Element, kind: str) -> list[Element]:
    own = [tags] if tags.kind == kind else []
    return own + [found for part in tags.parts for found in all_of(part, kind)]


def rows_of(table: Element) -> list[Element]:
    """Rows of the body: those of the head are repeated on every page, and tagged once."""
    return [row for row in all_of(table, "TR") if not any(cell.kind == "TH" for cell in row.parts)]


def hanging(word: Word, at: int) -> float:
    """How far a word may reach over an edge: signs at the end of a line hang over it, and half of a Chinese one is blank."""
    sign = word.text[at:][:1]
    if not sign or sign.isalnum():
        return SLACK
    return (0.55 if unicodedata.east_asian_width(sign) == "W" or sign in "「」『』（），。、；：" else 0.25) * (word.bottom - word.top)


def word_breaches(pages: list[Page]) -> list[str]:
    breaches = []
    for number, page in enumerate(pages, 1):
        lower = page.height - BOTTOM
        for word in page.words:
            if word.left < 0 or word.top < 0 or word.right > page.width or word.bottom > page.height:
                breaches.append(f"page {number}: “{word.text}” sticks out over the edge of the paper")
            elif word.left < LEFT - hanging(word, 0) or word.right > page.width - RIGHT + hanging(word, -1):
                breaches.append(f"page {number}: “{word.text}” sticks out of the text area at the side")
            # The area ends at the foot of the letters; tails below the line are not part of it.
            elif word.top < lower - SLACK and word.bottom > lower + 0.35 * (word.bottom - word.top):
                breaches.append(f"page {number}: “{word.text}” sticks out of the text area at the foot")
        ordered = sorted(page.words, key=lambda w: w.top)
        for i, word in enumerate(ordered):
            for other in ordered[i + 1:]:
                if other.top > word.bottom:
                    break
                if word.overlaps(other):
                    breaches.append(f"page {number}: “{word.text}” and “{other.text}” overlap")
    return breaches


def line_breaches(pages: list[Page]) -> list[str]:
    """A number stands in one line with its % and with the symbol whose value it is."""
    breaches = []
    for number, page in enumerate(pages, 1):
        for block in page.blocks:
            for before, line in zip(block, block[1:]):
                if not before or not line:
                    continue
                is_percentage = before[-1][-1:].isdigit() and line[0].startswith("%")
                is_value = len(line) > 1 and line[0] == "=" and line[1].lstrip("−+")[:1].isdigit()
                if is_percentage or is_value:
                    breaches.append(f"page {number}: “{before[-1]}” and “{line[0]}” stand in two lines")
    return breaches


def fill_breaches(pages: list[Page]) -> list[str]:
    breaches = []
    for number, page in enumerate(pages, 1):
        body = page.body()
        if number == len(pages):
            # Words of a line share a foot, but for indices and raised digits.
            lines = {round(w.bottom / 6) for w in body}
            if len(lines) < LEAST_LAST_LINES and len(pages) > 1:
                breaches.append(f"page {number}, the last one: it holds {len(lines)} lines")
        else:
            filled = (max((w.bottom for w in body), default=TOP) - TOP) / (page.height - TOP - BOTTOM)
            if filled < LEAST_FILLED:
                breaches.append(f"page {number}: only {100 * filled:.0f} % of it is filled")
    return breaches


def leaves_of(tags: Element) -> list[Element]:
    """Headings, tables and everything between them, in their order."""
    leaves = []
    for part in tags.parts:
        if part.kind in ("Document", "Sect", "Div", "NonStruct", "Part", ""):
            leaves += leaves_of(part)
        elif part.pages:
            leaves.append(part)
    return leaves


def tag_breaches(tags: Element) -> list[str]:
    breaches = []
    for count, table in enumerate(all_of(tags, "Table"), 1):
        rows = rows_of(table)
        for page in sorted(set().union(*(row.pages for row in rows))):
            here = [row for row in rows if min(row.pages, default=0) == page]
            if len(here) == 1 and len(rows) > 1:
                breaches.append(f"page {page}: one single row of table {count} in the document, which has {len(rows)}")
        breaches += [f"page {min(row.pages)}: a row of table {count} goes on at the next page" for row in rows
                     if len(row.pages) > 1]
    leaves = leaves_of(tags)
    for leaf, following in zip(leaves, leaves[1:]):
        if leaf.kind in ("H1", "H2", "H3", "H4") and min(following.pages) != max(leaf.pages):
            breaches.append(f"page {max(leaf.pages)}: a heading stands at the foot, and what follows on the next page")
        if leaf.kind in ("P", "Span", "Strong", "Caption") and following.kind == "Table" and min(following.pages) != max(leaf.pages):
            breaches.append(f"page {max(leaf.pages)}: the words above a table stand at the foot, and it on the next page")
    return breaches


def layout_breaches(pdf: Path) -> list[str]:
    pages = pages_of(pdf)
    return word_breaches(pages) + line_breaches(pages) + fill_breaches(pages) + tag_breaches(tags_of(pdf))
