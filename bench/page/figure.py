"""figure.py: charts as SVG, legible on light and dark pages and when scaled down to a telephone."""
import html
import math

WIDTH, RIGHT, ROW, FONT = 640, 20, 22, 14
FROE, OTHER = "#2f6fdb", "#d1691c"
COLOURS = {"Boost": "#2f6fdb", "Boost, segments": "#17a2b8", "CGAL": "#2c8f57", "GEOS": "#9b59c6", "plain grid": "#b8860b",
           "Embree": "#d1691c", "nanoflann": "#c8375c"}
STYLE = """<style>
text{font:%dpx system-ui,sans-serif;fill:#1f2328}.small{font-size:12px;fill:#59636e}.back{fill:#fff}
.line{stroke:#d1d9e0}.one{stroke:#1f2328;stroke-width:1.5}.slower{fill:#fbeeee}
@media(prefers-color-scheme:dark){text{fill:#e6edf3}.small{fill:#9da7b3}.back{fill:#0d1117}.line{stroke:#3d444d}
.one{stroke:#e6edf3}.slower{fill:#2b1a1d}}
</style>""" % FONT


def text(x, y, what, cls="", anchor="start", colour=""):
    return '<text x="%g" y="%g"%s text-anchor="%s"%s>%s</text>' % (
        x, y, ' class="%s"' % cls if cls else "", anchor, ' style="fill:%s"' % colour if colour else "", html.escape(what))


def document(height, title, parts):
    return "\n".join(
        ['<svg xmlns="http://www.w3.org/2000/svg" width="%d" height="%d" viewBox="0 0 %d %d" role="img">'
         % (WIDTH, height, WIDTH, height), "<title>%s</title>" % html.escape(title), STYLE,
         '<rect class="back" width="100%" height="100%" rx="6"/>'] + parts + ["</svg>", ""])


def tick(ratio):
    return "1/%g" % (1 / ratio) if ratio < 1 else "%g" % ratio


def ratios(title, rows, less="the other program is faster", more="froe is faster"):
    """rows: (work, program, ratios by scene). One line each: a mark for each scene, a bar from the least to the most."""
    programs = list(dict.fromkeys(program for _, program, _ in rows))
    left = 30 + 7.4 * max(len(work) for work, _, _ in rows)
    colour = {p: COLOURS.get(p, OTHER) for p in programs}
    low = min(0.5, min(min(r) for _, _, r in rows))
    high = max(2, max(max(r) for _, _, r in rows))
    first, last = math.floor(math.log2(low)), math.ceil(math.log2(high))
    top, height = 84, 84 + ROW * len(rows) + 34

    def x(ratio):
        return left + (WIDTH - left - RIGHT) * (math.log2(ratio) - first) / (last - first)

    parts = [text(14, 26, title)]
    at = 14
    for p in programs:  # the key
        parts += ['<rect x="%g" y="38" width="12" height="12" rx="2" fill="%s"/>' % (at, colour[p]), text(at + 17, 49, p, "small")]
        at += 34 + 6.6 * len(p)
    parts.append('<rect class="slower" x="%g" y="%g" width="%g" height="%g"/>' % (left, top - 8, x(1) - left, ROW * len(rows) + 12))
    for e in range(first, last + 1):
        parts.append('<path class="%s" d="M%g %gV%g"/>' % ("one" if e == 0 else "line", x(2 ** e), top - 8, height - 30))
        if last - first <= 8 or e % 2 == 0:
            parts.append(text(x(2 ** e), height - 14, tick(2 ** e), "small", "middle"))
    parts.append(text(x(1) - 6, top - 14, less if x(1) - left > 170 else "slower", "small", "end"))
    parts.append(text(x(1) + 6, top - 14, more, "small"))
    previous = None
    for i, (work, program, values) in enumerate(rows):
        y = top + ROW * i + ROW / 2
        if work != previous:
            parts.append(text(14, y + 3, work))
            if i:
                parts.append('<path class="line" d="M14 %gH%g"/>' % (y - ROW / 2 - 1, WIDTH - RIGHT))
        previous = work
        c = colour[program]
        parts.append('<path d="M%g %gH%g" stroke="%s" stroke-width="3" opacity=".45"/>' % (x(min(values)), y, x(max(values)), c))
        parts += ['<circle cx="%.1f" cy="%g" r="4.5" fill="%s" opacity=".85"/>' % (x(v), y, c) for v in values]
    return document(height, title, parts)


def bars(title, groups, unit):
    """groups: (name, [(program, value)]): bars below each other."""
    count = sum(len(bars) for _, bars in groups)
    height = 50 + 18 * count + 12 * len(groups)
    most = max(v for _, bars in groups for _, v in bars)
    left = 270
    parts, y = [text(14, 26, title)], 44
    for name, of in groups:
        parts.append(text(14, y + 13, name))
        for i, (program, value) in enumerate(of):
            wide = (WIDTH - left - 60) * value / most
            parts += [text(left - 6, y + 13, program, "small", "end"),
                      '<rect x="%d" y="%g" width="%.1f" height="14" rx="2" fill="%s"/>'
                      % (left, y + 1, max(wide, 1), FROE if program.startswith("froe") else OTHER),
                      text(left + wide + 6, y + 13, unit(value), "small")]
            y += 18
        y += 12
    return document(height, title, parts)
