"""The page: text, tables and figures as HTML. Whatever is text gets escaped; HTML is of type Html."""

import base64
import html
import re
from dataclasses import dataclass, field

from reproduce import formulas, paper

STYLE = """
:root { color-scheme: light; }
* { box-sizing: border-box; }
body { margin: 0 auto; padding: 2rem 1.25rem 4rem; max-width: 1100px; background: #fff; color: #1c1e21;
  font: 16px/1.55 system-ui, -apple-system, "Segoe UI", Roboto, "Noto Sans", "Liberation Sans", sans-serif; }
h1 { font-size: 1.8rem; line-height: 1.25; margin: 0 0 .4rem; }
h2 { font-size: 1.35rem; line-height: 1.3; margin: 3.2rem 0 .8rem; padding-top: .9rem;
  border-top: 1px solid #d5d9de; }
h3 { font-size: 1.05rem; margin: 1.6rem 0 .4rem; }
p, ul { max-width: 78ch; margin: .6rem 0; }
.lead { color: #4a5058; }
a { color: #0b5cad; }
nav ol { columns: 2; column-gap: 3rem; padding-left: 1.4rem; margin: .4rem 0; }
nav li { break-inside: avoid; }
table { border-collapse: collapse; margin: .9rem 0 1.1rem; font-size: .86rem; line-height: 1.4;
  font-variant-numeric: tabular-nums; }
.wide { overflow-x: auto; }
caption { text-align: left; caption-side: top; padding-bottom: .35rem; font-size: .9rem; color: #33383e; }
th, td { padding: .28rem .6rem; vertical-align: top; text-align: left; }
thead th { border-bottom: 1.5px solid #8a929b; vertical-align: bottom; font-weight: 600; }
tbody th { font-weight: 500; white-space: nowrap; }
tbody tr { border-bottom: 1px solid #e7eaed; }
tbody tr:last-child { border-bottom: 1.5px solid #8a929b; }
th.number, td.number { text-align: right; }
td.number { white-space: nowrap; }
figure { margin: 1.2rem 0 1.5rem; break-inside: avoid; }
figure svg, figure img { display: block; max-width: 100%; height: auto; margin: 0 auto; }
figcaption { font-size: .9rem; color: #33383e; margin: .5rem 0 0; max-width: 90ch; }
.holds { color: #14692e; font-weight: 600; white-space: nowrap; }
.fails { color: #a4161a; font-weight: 700; white-space: nowrap; }
.unknown { color: #6b727a; }
.differs { border-left: 3px solid #c9922b; padding-left: .8rem; }
.later { color: #4a5058; }
details { margin: 1rem 0; font-size: .9rem; }
summary { cursor: pointer; color: #0b5cad; }
pre { background: #f5f7f9; border: 1px solid #e1e5e9; border-radius: 4px; padding: .6rem .8rem; font-size: .78rem;
  line-height: 1.45; white-space: pre-wrap; overflow-wrap: anywhere; }
code { font-size: .92em; }
@media (max-width: 700px) { nav ol { columns: 1; } }
@media print { body { max-width: none; padding: 0; font-size: 10pt; } h2, h3 { break-after: avoid; }
  tr { break-inside: avoid; } details { display: none; } a { color: inherit; text-decoration: none; } }
"""


class Html(str):
    """Text that is HTML already."""


SYMBOL = re.compile(r"\b(r|d|beta)_(f|c|hex|i|upper)(?![A-Za-z_])")


def escape(text):
    """As HTML, with the subscripts of r_f, r_c, d_hex, beta_i and beta_upper; `code` between backticks."""
    if isinstance(text, Html):
        return text
    parts = html.escape(str(text)).split("`")
    for k, part in enumerate(parts):
        parts[k] = f"<code>{part}</code>" if k % 2 else SYMBOL.sub(r"\1<sub>\2</sub>", part)
    return Html("".join(parts))


def plain(value, digits):
    return f"{value:.{digits}f}".replace("-", "\u2212")


def number(value, digits=3):
    """With a fixed number of digits, so that a column's points align; a dash for what there is not."""
    return "\u2013" if value is None else plain(value, digits)


def span(values, digits=3):
    """Mean, and smallest to largest in parentheses unless they look the same; of those that are known."""
    values = list(values)
    known = formulas.known(values)
    if not known:
        return number(None)
    low, high = number(min(known), digits), number(max(known), digits)
    mean = number(sum(known) / len(known), digits)
    missing = len(values) - len(known)
    return ((mean if low == high else f"{mean} ({low}\u2013{high})")
            + (f"; {missing} of {len(values)} not available" if missing else ""))


def percent(share, digits=1):
    return number(None) if share is None else f"{100 * share:.{digits}f} %"


def holds(condition):
    """A verdict that can be seen: computed, never written. None: there was nothing to compute it from."""
    if condition is None:
        return not_available()
    return Html('<span class="holds">holds</span>' if condition else '<span class="fails">FAILS</span>')


def agrees(condition):
    """The same for what the paper says without a proof."""
    if condition is None:
        return not_available()
    return Html('<span class="holds">agrees</span>' if condition else '<span class="fails">DIFFERS</span>')


def bar_verdict(upper, bar, beaten_by=()):
    """Whether what is proven keeps to a bar, and no rival is better."""
    if upper is None:
        return Html('<span class="unknown">not proven</span>')
    if upper > bar:
        return Html(f'<span class="fails">above {bar:.2f}</span>')
    if beaten_by:
        return Html(f'<span class="fails">beaten by {escape(", ".join(beaten_by))}</span>')
    return Html(f'<span class="holds">at most {bar:.2f}</span>')


def not_available():
    return Html(f'<span class="unknown">{html.escape(paper.NOT_AVAILABLE_SHORT)}</span>')


def paragraph(text, kind=None):
    return Html(f'<p class="{kind}">{escape(text)}</p>\n' if kind else f"<p>{escape(text)}</p>\n")


def heading(text):
    return Html(f"<h3>{escape(text)}</h3>\n")


def bullets(items):
    return Html("<ul>\n" + "".join(f"<li>{escape(item)}</li>\n" for item in items) + "</ul>\n")


def cell(value, is_number, row_heading):
    tag = 'th scope="row"' if row_heading else "td"
    align = ' class="number"' if is_number else ""
    return f"<{tag}{align}>{escape(value)}</{tag.split()[0]}>"


def table(caption, columns, rows):
    """Columns that are numbers have a # before their name; the first column names the row."""
    numbers = [name.startswith("#") for name in columns]
    for row in rows:
        if len(row) != len(columns):
            raise ValueError(f"{len(row)} cells for {len(columns)} columns: {row}")
    head = "".join(f'<th scope="col"{" class=number" if is_number else ""}>{escape(name.lstrip("#"))}</th>'
                   for name, is_number in zip(columns, numbers))
    body = "".join("<tr>" + "".join(cell(value, is_number, k == 0)
                                    for k, (value, is_number) in enumerate(zip(row, numbers))) + "</tr>\n"
                   for row in rows)
    return Html(f'<div class="wide"><table>\n<caption>{escape(caption)}</caption>\n'
                f"<thead><tr>{head}</tr></thead>\n<tbody>\n{body}</tbody>\n</table></div>\n")


def drawing(picture, alt):
    """What a figure shows, put into the page."""
    if picture.kind == "svg":
        svg = picture.data.decode()
        return svg.replace("<svg ", f'<svg role="img" aria-label="{html.escape(alt)}" ', 1)
    data = base64.b64encode(picture.data).decode()
    return f'<img alt="{html.escape(alt)}" src="data:image/{picture.kind};base64,{data}">'


@dataclass
class Finding:
    """A row of the table at the top."""

    what: str
    paper: str
    ours: str
    verdict: str


@dataclass
class Section:
    anchor: str
    title: str
    number: int = 0
    parts: list = field(default_factory=list)
    findings: list = field(default_factory=list)
    seconds: float = 0
    figures: int = 0
    tables: int = 0

    def text(self, text, kind=None):
        self.parts.append(paragraph(text, kind))

    def heading(self, text):
        self.parts.append(heading(text))

    def bullets(self, items):
        self.parts.append(bullets(items))

    def table(self, caption, columns, rows):
        self.tables += 1
        self.parts.append(table(f"Table {self.number}.{self.tables}. {caption}", columns, rows))

    def figure(self, picture, caption, alt):
        self.figures += 1
        numbered = escape(f"Figure {self.number}.{self.figures}. {caption}")
        self.parts.append(Html(f"<figure>\n{drawing(picture, alt)}\n<figcaption>{numbered}</figcaption>\n"
                               "</figure>\n"))

    def finding(self, what, said, ours, verdict):
        self.findings.append(Finding(what, said, ours, verdict))

    def requests(self, *commands):
        shown = "\n\n".join(commands)
        self.parts.append(Html("<details><summary>The requests, as "
                               f"curl</summary>\n<pre>{html.escape(shown)}</pre></details>\n"))

    def html(self):
        return (f'<section id="{self.anchor}">\n<h2>{self.number}. {escape(self.title)}</h2>\n'
                + "".join(self.parts) + "</section>\n")


def contents(sections):
    items = "".join(f'<li><a href="#{s.anchor}">{escape(s.title)}</a></li>\n' for s in sections)
    return f'<nav aria-label="Contents"><h3>Contents</h3><ol>\n{items}</ol></nav>\n'


def summary(sections):
    rows = [(Html(f'<a href="#{s.anchor}">{s.number}</a>'), f.what, f.paper, f.ours, f.verdict)
            for s in sections for f in s.findings]
    return table("What the paper says and what this service does. All of \u201cours\u201d was computed for this "
                 "page.",
                 ["section", "what", "the paper", "ours", "verdict"], rows)


def page(title, lead, sections, facts):
    """The whole page; `facts` are (name, value) of how it was made."""
    made = table("How this page was made.", ["what", "value"], facts)
    made += table("Seconds that each section took; work that several share is counted with the first of them.",
                  ["section", "#seconds"], [(f"{s.number}. {s.title}", plain(s.seconds, 1)) for s in sections])
    return (f'<!DOCTYPE html>\n<html lang="en">\n<head>\n<meta charset="utf-8">\n'
            f'<meta name="viewport" content="width=device-width, initial-scale=1">\n'
            f"<title>{html.escape(title)}</title>\n<style>{STYLE}</style>\n</head>\n<body>\n"
            f"<header>\n<h1>{escape(title)}</h1>\n{lead}</header>\n<main>\n{contents(sections)}"
            f'<section id="summary">\n<h2>Summary</h2>\n{summary(sections)}</section>\n'
            f'<section id="reproduce">\n<h2>How to reproduce this page</h2>\n'
            f"<pre>./dev reproduce</pre>\n{made}</section>\n"
            + "".join(s.html() for s in sections) + "</main>\n</body>\n</html>\n")
