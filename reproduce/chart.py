"""A small chart as SVG, for what the service has no picture of."""

import html
import math
from dataclasses import dataclass, field

from reproduce import formulas
from reproduce.client import Picture

COLORS = ["#0072b2", "#d55e00", "#009e73", "#b8529a", "#000000", "#56b4e9", "#e69f00"]
FONT = "DejaVu Sans, Verdana, sans-serif"
LEFT, RIGHT, TOP, BOTTOM, LEGEND_ROW, MARK = 62, 14, 10, 44, 20, 3.5


@dataclass
class Series:
    label: str
    points: list  # (x, y)
    line: bool = True
    dashed: bool = False
    marks: bool = True


@dataclass
class Axis:
    label: str
    low: float
    high: float

    def ticks(self):
        rough = (self.high - self.low) / 6
        power = 10 ** math.floor(math.log10(rough))
        step = next(power * k for k in (1, 2, 5, 10) if power * k >= rough)
        first = math.ceil(self.low / step - 1e-9)
        return [k * step for k in range(first, math.floor(self.high / step + 1e-9) + 1)], step


def axis_over(label, low, high, values):
    """From low to high, and somewhat beyond the values that are not between them."""
    known = formulas.known(values)
    room = 0.03 * (high - low)
    least, most = min(known, default=low), max(known, default=high)
    return Axis(label, low if least >= low else least - room, high if most <= high else most + room)


@dataclass
class Chart:
    title: str
    x: Axis
    y: Axis
    series: list = field(default_factory=list)
    width: int = 520
    height: int = 320

    def svg(self):
        """The panel with its legend above it; the size of both together is in `size`."""
        top = TOP + LEGEND_ROW * math.ceil(len(self.series) / 2)
        self._top, self._bottom = top, top + self.height - BOTTOM - TOP
        return "".join([*self._grid(), *self._legend(), *(part for k in range(len(self.series))
                                                          for part in self._curve(k))])

    @property
    def full_height(self):
        return self.height + LEGEND_ROW * math.ceil(len(self.series) / 2)

    def _px(self, x, y):
        across = (x - self.x.low) / (self.x.high - self.x.low)
        up = (y - self.y.low) / (self.y.high - self.y.low)
        return (LEFT + across * (self.width - LEFT - RIGHT), self._bottom - up * (self._bottom - self._top))

    def _grid(self):
        right = self.width - RIGHT
        for value, step in ((v, self.x.ticks()[1]) for v in self.x.ticks()[0]):
            x, _ = self._px(value, self.y.low)
            yield f'<path d="M{x:.1f} {self._top}V{self._bottom}" stroke="#ddd" fill="none"/>'
            yield _text(x, self._bottom + 16, label_of(value, step), "middle")
        for value, step in ((v, self.y.ticks()[1]) for v in self.y.ticks()[0]):
            _, y = self._px(self.x.low, value)
            yield f'<path d="M{LEFT} {y:.1f}H{right}" stroke="#ddd" fill="none"/>'
            yield _text(LEFT - 7, y + 4, label_of(value, step), "end")
        yield (f'<rect x="{LEFT}" y="{self._top}" width="{right - LEFT}" height="{self._bottom - self._top}" '
               'fill="none" stroke="#444"/>')
        yield _text((LEFT + right) / 2, self._bottom + 36, self.x.label, "middle")
        middle = (self._top + self._bottom) / 2
        yield (f'<text transform="translate(16 {middle:.1f}) rotate(-90)" text-anchor="middle" fill="#222">'
               f"{html.escape(self.y.label)}</text>")

    def _legend(self):
        half = (self.width - LEFT) / 2
        for k, series in enumerate(self.series):
            x, y = LEFT + half * (k % 2), TOP + LEGEND_ROW * (k // 2) + 6
            if series.line:
                yield f'<path d="M{x} {y}H{x + 22}" {self._stroke(k)}/>'
            if series.marks:
                yield f'<circle cx="{x + 11}" cy="{y}" r="{MARK}" fill="{color_of(k)}"/>'
            yield _text(x + 30, y + 4, series.label, "start")

    def _curve(self, k):
        series = self.series[k]
        at = [self._px(x, y) for x, y in series.points]
        if series.line and len(at) > 1:
            yield f'<path d="M{"L".join(f"{x:.1f} {y:.1f}" for x, y in at)}" {self._stroke(k)}/>'
        if series.marks:
            for x, y in at:
                yield f'<circle cx="{x:.1f}" cy="{y:.1f}" r="{MARK}" fill="{color_of(k)}"/>'

    def _stroke(self, k):
        dash = ' stroke-dasharray="5 4"' if self.series[k].dashed else ""
        return f'stroke="{color_of(k)}" stroke-width="1.6" fill="none"{dash}'


def color_of(k):
    return COLORS[k % len(COLORS)]


def label_of(value, step):
    digits = max(0, -math.floor(math.log10(step) + 1e-9))
    return f"{value + 0.0:.{digits}f}".replace("-", "\u2212")


def _text(x, y, text, anchor):
    return f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}" fill="#222">{html.escape(text)}</text>'


def side_by_side(charts, title):
    """One picture of them all in a row."""
    width = sum(chart.width for chart in charts)
    height = max(chart.full_height for chart in charts)
    parts, x = [], 0
    for chart in charts:
        parts.append(f'<g transform="translate({x} 0)"><title>{html.escape(chart.title)}</title>{chart.svg()}</g>')
        x += chart.width
    svg = (f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" viewBox="0 0 {width} '
           f'{height}" '
           f'font-family="{FONT}" font-size="12"><title>{html.escape(title)}</title>{"".join(parts)}</svg>')
    return Picture("svg", svg.encode())
