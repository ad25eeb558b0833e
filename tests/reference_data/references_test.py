"""Every work cited in the sources stands in reference_data/references.bib, once, in alphabetical order.

Cited means [Key] in a source or a document, a key in a string after `cites`, or one in a table's line `# cites:`, where a
key is a name, a year and perhaps a word: Darwin1959, GrallaLupsasca2020Lensing.
"""

import pathlib
import re
import sys
import unittest

ROOT = pathlib.Path(sys.argv.pop(1)) if len(sys.argv) > 1 else pathlib.Path(__file__).resolve().parents[2]
FOLDERS = ("metrics", "integrators", "core", "validation", "reports", "tools", "docs", "tests", "scenes", "reference_data")
ENDINGS = {".hpp", ".cpp", ".md", ".py", ".toml", ".csv"}
KEY = r"[A-Z][A-Za-z]*(?:18|19|20)\d\d[A-Za-z]*"
REQUIRED = {
    "article": {"author", "title", "journal", "year"},
    "book": {"author", "title", "publisher", "year"},
    "incollection": {"author", "title", "booktitle", "publisher", "year"},
    "techreport": {"author", "title", "institution", "year"},
    "misc": {"author", "title", "year"},
}


def entries(text):
    """(kind, key, fields) of each entry."""
    for match in re.finditer(r"^@(\w+)\{([^,]+),\n(.*?)^\}", text, re.MULTILINE | re.DOTALL):
        yield match[1], match[2], set(re.findall(r"(\w+) = \{", match[3]))


def cited_keys(text):
    """The keys that a source cites."""
    keys = set(re.findall(rf"\[({KEY})\]", text))
    for listed in re.findall(r'cites\s*=\s*((?:"[^"]*"\s*)+)', text):
        keys.update(re.findall(rf"\b{KEY}\b", listed))
    for listed in re.findall(r"^# cites: (.*)$", text, re.MULTILINE):
        keys.update(re.findall(rf"\b{KEY}\b", listed))
    return keys


def sources():
    for folder in FOLDERS:
        for path in sorted((ROOT / folder).rglob("*")):
            if path.suffix in ENDINGS and path != pathlib.Path(__file__).resolve():
                yield path


class References(unittest.TestCase):
    def setUp(self):
        self.entries = list(entries((ROOT / "reference_data" / "references.bib").read_text(encoding="utf-8")))

    def test_each_cited_key_is_in_the_bibliography(self):
        known = {key for _, key, _ in self.entries}
        missing = {}
        for path in sources():
            for key in cited_keys(path.read_text(encoding="utf-8")) - known:
                missing.setdefault(key, []).append(str(path.relative_to(ROOT)))
        self.assertEqual(missing, {})

    def test_the_reader_finds_citations(self):
        text = 'Cites: [Darwin1959] [GrallaLupsasca2020Lensing]\n.cites = "Kerr1963 "\n    "Carter1968", [0] [M2]'
        self.assertEqual(cited_keys(text), {"Darwin1959", "GrallaLupsasca2020Lensing", "Kerr1963", "Carter1968"})
        self.assertGreater(sum(bool(cited_keys(path.read_text(encoding="utf-8"))) for path in sources()), 2)

    def test_keys_are_alphabetical_and_unique(self):
        keys = [key for _, key, _ in self.entries]
        self.assertGreater(len(keys), 30)
        self.assertEqual(keys, sorted(set(keys), key=sort_key))

    def test_each_entry_names_author_title_place_and_year(self):
        for kind, key, fields in self.entries:
            with self.subTest(key=key):
                self.assertRegex(key, rf"^{KEY}$")
                self.assertEqual(REQUIRED[kind] - fields, set())


def sort_key(key):
    """By authors, then year: Bardeen1973 stands before BardeenPressTeukolsky1972."""
    return re.match(r"([A-Za-z]+)(.*)", key).groups()


if __name__ == "__main__":
    unittest.main()
