"""Whether a finished page has all it should."""

from html.parser import HTMLParser

VOID = {"meta", "img", "br", "link", "hr", "input"}


class _Page(HTMLParser):
    def __init__(self):
        super().__init__()
        self.faults = []
        self.ids = []
        self.content = {}  # by section: the tags in it
        self._open = []
        self._section = None

    def handle_starttag(self, tag, attributes):
        self._look_at(tag, dict(attributes))
        if tag not in VOID:
            self._open.append(tag)

    def handle_startendtag(self, tag, attributes):
        self._look_at(tag, dict(attributes))

    def handle_endtag(self, tag):
        if tag in VOID:
            return
        if not self._open or self._open.pop() != tag:
            self.faults.append(f"</{tag}> closes what is not open")
        if tag == "section":
            self._section = None

    def close(self):
        super().close()
        if self._open:
            self.faults.append(f"never closed: {', '.join(self._open)}")

    def _look_at(self, tag, attributes):
        if "id" in attributes:
            if attributes["id"] in self.ids:
                self.faults.append(f"two elements have the id {attributes['id']}")
            self.ids.append(attributes["id"])
        if tag == "section":
            self._section = attributes.get("id")
            self.content[self._section] = set()
        elif self._section:
            self.content[self._section].add(tag)
        for name in ("src", "href", "xlink:href"):
            target = attributes.get(name, "#")
            if not target.startswith(("#", "data:")):
                self.faults.append(f"<{tag}> needs {target[:60]}, which is not in the page")
        if tag == "script":
            self.faults.append("there is a script")
        if tag == "img" and not attributes.get("alt"):
            self.faults.append("an image says nothing to those who can't see it")


def faults(page, sections):
    """What is wrong with it, in sentences; `sections` maps ids to the tags each has to have."""
    seen = _Page()
    seen.feed(page)
    seen.close()
    found = list(seen.faults)
    for anchor, tags in sections.items():
        if anchor not in seen.content:
            found.append(f"the section {anchor} is missing")
            continue
        found += [f"the section {anchor} has no {tag}" for tag in tags if tag not in seen.content[anchor]]
    return found
