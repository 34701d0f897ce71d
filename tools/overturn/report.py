"""Makes a page from the answers of overturn assess: what to secure first, why, and what is not known. One HTML file
with its picture, which needs nothing else and can be printed."""

from __future__ import annotations

import io
import json
import math
import pathlib
import subprocess
import sys

import matplotlib
import numpy as np
from jinja2 import Environment
from markupsafe import Markup
from matplotlib import pyplot
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from overturn.installation import find_overturn
from overturn.output_file import write_text
from overturn.regions import REGIONS, STANDS, TOPPLES, UNDECIDED
from overturn.tool import ToolError, parser_of

EXAMPLE = """\
example:
  tools/report jobs/statues.csv --period 0.5 --pga 0.4           # writes statues.html
  overturn assess jobs/statues.csv --period 0.5 --json > a.json  # the same in two steps
  tools/report a.json

A table is passed to overturn assess with all options but -o; overturn assess --help lists them."""

MOST_BARS = 60
MADE_BY = "<!-- a report of overturn -->"
RANKS = ("topples", "undecided", "rocks and slides", "rocks", "slides", "stands", None)
TEXTS = ("object", "verdict", "worst_motion", "note")  # of the answers, not of the table
ASSUMPTIONS = (
    "Each object is rigid, stands free on a rigid base, and moves in one vertical plane; it does not break.",
    "The restitution at impacts is that of the table or, without it, the largest one, r_max, of a block that does not "
    "slip: the least favourable one in most cases, but not in all.",
    "The motions are those named above. Others, also of the same strength, may topple other objects.",
)
WITHOUT_FRICTION = ("No object slips on its base. Give the column friction to let those slip whose base is smooth: sliding "
                    "may save an object or topple it.")
WITH_FRICTION = "Objects slip on their base with the given coefficient of friction, which is the same at rest and in motion."

PAGE = """\
<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
{{ made_by }}
<title>{{ title }}</title>
<style>
body { font: 11pt/1.4 Georgia, "DejaVu Serif", serif; color: #1a1a1a; max-width: 54rem; margin: 2rem auto; padding: 0 1rem; }
h1 { font-size: 1.5rem; } h2 { font-size: 1.15rem; margin-top: 1.6rem; }
table { border-collapse: collapse; width: 100%; font: 9.5pt/1.35 "Helvetica Neue", Arial, "DejaVu Sans", sans-serif; }
th, td { text-align: right; padding: 0.2rem 0.45rem; border-bottom: 1px solid #ccc; vertical-align: top; }
th:first-child, td:first-child, td.text, th.text { text-align: left; }
td { white-space: nowrap; } td:first-child, td.text { white-space: normal; overflow-wrap: anywhere; min-width: 5rem; }
td:first-child { min-width: 9rem; } td .note { font-size: inherit; }
.wide { overflow-x: auto; }
thead { display: table-header-group; }
.verdict { font-weight: bold; } .topples { color: {{ topples }}; }
svg { width: 100%; height: auto; } .note { color: #444; font-size: 9.5pt; }
@media print { body { margin: 0; max-width: none; font-size: 9.5pt; } .wide { overflow-x: visible; }
  table { font-size: 7.5pt; } td:first-child { min-width: 11rem; } td.text { min-width: 5rem; }
  h2 { margin-top: 0.8rem; } p, ul, ol { margin: 0.4rem 0; } svg { max-height: 21rem; } th, td { padding: 0.1rem 0.25rem; } td { white-space: normal; } tr, li, svg { break-inside: avoid; }
  @page { size: A4; margin: 15mm; } }
</style>
</head>
<body>
<h1>{{ title }}</h1>
<p>{{ motion }}.{% if strength %} Asked: {{ strength }}.{% endif %}</p>
<h2>What to secure first</h2>
{% if asked %}
{% if toppling %}
<p>{{ toppling|length }} of {{ objects|length }} objects {{ 'topples' if toppling|length == 1 else 'topple' }}{% if toppling[0].cases > 1 %}
in at least one of up to {{ most_cases }} cases (motions, periods and directions){% endif %}:</p>
<ol>{% for each in toppling[:20] %}
<li><b>{{ each.title }}</b>{% if each.description %} ({{ each.description }}){% endif %}: from {{ each.topples_from|strength }}{% if each.cases > 1 %}, in
{{ (100 * each.share_toppling)|round|int }} % of its cases{% endif %}</li>{% endfor %}</ol>
{% if toppling|length > 20 %}<p>The others follow in the table.</p>{% endif %}
{% if widths %}<p>{{ widths.object }} is {{ '%.4g'|format(widths.width) }} m wide. {% if widths.all %}With more width and all else
equal, it stands from {{ widths.all|width }} m{% if widths.cases > 1 %} in all cases{% endif %}{% if widths.most %}, from {{
widths.most|width }} m in {{ widths.most_cases }} of {{ widths.cases }}{% endif %}{% else %}No wider one is known to stand in all cases{% endif %}, as searched up
to {{ '%.4g'|format(widths.end) }} m in steps of {{ '%.2g'|format(widths.step) }} m: single widths between them may topple. Allow a
margin.</p>{% endif %}
{% else %}<p>None of {{ objects|length }} objects is found to topple.{% if undecided %} Some are undecided, see below.{% endif %}</p>
{% endif %}
{% if near %}<p>Near a verdict: {% for each in near %}{{ each.title }} ({{ each.note }}){{ '; ' if not loop.last }}{% endfor %}.</p>{% endif %}
{% else %}<p>In the order of the lowest strength that topples them; no strength was asked for.</p>{% endif %}
<h2>Why</h2>
{{ picture }}
<div class="wide"><table>
<thead><tr><th>object</th>{% if asked %}<th class="text">verdict</th><th>cases that topple it</th><th>largest tilt over
alpha</th>{% endif %}<th>lifts from [g]</th>{% if has_slip %}<th>slides from [g]</th>{% endif %}<th>topples from
[g]</th>{% if most_cases > 1 %}<th>median [g]</th>{% endif %}{% if has_slip and asked %}<th>slides [mm]</th>{% endif %}<th
class="text">note</th></tr></thead>
<tbody>{% for each in objects %}
<tr><td>{{ each.title }}{% if each.description %}<br><span class="note">{{ each.description }}</span>{% endif %}</td>{% if asked %}<td class="text verdict{{ ' topples' if each.verdict == 'topples' }}">{{ each.verdict }}</td>
<td>{{ (100 * each.share_toppling)|round|int }} %</td><td>{{ each|tilt }}</td>{% endif %}<td>{{ each.lifts_from|number('never') }}</td>{%
if has_slip %}<td>{{ each.slides_from|number('lifts first') }}</td>{% endif %}<td>{{
each.topples_from|number(each|above_search) }}</td>{% if most_cases > 1 %}<td>{{
each.median|number(each|above_search) }}</td>{% endif %}{% if has_slip and asked %}<td>{{ each|slide }}</td>{%
endif %}<td class="text">{{ each.note }}</td></tr>{% endfor %}
</tbody></table></div>
<h2>What is not known</h2>
<ul>
{% if undecided %}<li>Undecided: {{ undecided|map(attribute='title')|join(', ') }}. Treat them as objects that topple.</li>{% endif %}
{% if unsettled %}<li>At lower strengths than those that topple them, undecided: {{ unsettled|map(attribute='title')|join(', ') }}.</li>{% endif %}
{% if open_ended %}<li>Nothing is known above the search, {{ '%.4g'|format(open_ended[0].end_of_search) }} g, of: {{
open_ended|map(attribute='title')|join(', ') }}.</li>{% endif %}
<li>Strengths are searched in {% if fine %}fine steps: only very narrow{% else %}steps of at most 0.5 %: narrower{% endif %} ranges
that topple an object may be missed.</li>
{% if is_floor %}<li>The motion of a floor follows from a model of the building: other periods, damping and shapes of its modes
give other verdicts.</li>
{% endif %}{% for each in assumptions %}<li>{{ each }}</li>
{% endfor %}{% for each in warnings %}<li>Check the table: {{ each }}.</li>
{% endfor %}</ul>
<p class="note">overturn {{ version }}, table {{ table }}. Strengths are {{ measure }} over g = {{ gravity }} m/s&sup2;.
At the tilt alpha, an object is balanced on its edge.</p>
</body>
</html>
"""


def answers_in(path, options):
    """Returns the answers in a file of overturn assess --json, or with these options for a table."""
    try:
        if path.endswith(".json"):
            text = pathlib.Path(path).read_text(encoding="utf-8")
        else:
            run = subprocess.run([find_overturn(None), "assess", path, "--json", *options], stdout=subprocess.PIPE,
                                 encoding="utf-8")
            if run.returncode:
                sys.exit(run.returncode)  # the program has told why
            text = run.stdout
        answers = json.loads(text)
        if not answers["objects"]:
            raise KeyError("objects")
    except OSError as error:
        raise ToolError(f"cannot read \"{path}\": {error.strerror}.") from error
    except (ValueError, KeyError, TypeError) as error:
        raise ToolError(f"\"{path}\" does not contain the answers of overturn assess --json.") from error
    return answers


def number(value, otherwise):
    """Returns a strength, rounded down, or another text without one."""
    return otherwise if value is None else f"{math.floor(value * 1e4) / 1e4:.4f}"


def above_search(row):
    return f"above {row['end_of_search']:.4g}"


def tilt(row):
    return {"topples": "over", "undecided": "unknown"}.get(row["verdict"]) or (
        "unknown" if row["peak_of_alpha"] is None else f"{100 * row['peak_of_alpha']:.0f} %")


def slide(row):
    return "unknown" if row["slide"] is None else f"{1000 * row['slide']:.3g}"


def titles_of(rows):
    """Returns what people call the objects: the column `azimuth_of`, the column `name`, the first column of texts, or
    the number of the row in the table, in this order."""
    text = next((key for key in ("azimuth_of", "name", *rows[0]) if key not in TEXTS and isinstance(rows[0].get(key), str)), None)
    return [str(row[text]) if text else f"object {row['object']}" for row in rows]


def descriptions_of(rows):
    """Returns what else the table says of the objects: the other texts, and the size."""
    def describe(row):
        texts = [value for key, value in row.items()
                 if key not in (*TEXTS, "title") and isinstance(value, str) and value != row["title"]]
        size = [f"{row['width']:g} m x {row['height']:g} m"] if row.get("width") and row.get("height") else []
        return ", ".join([*filter(None, texts), *size])
    return [describe(row) for row in rows]


def draw(rows, asked, measure):
    """Draws the strengths at which nothing is found to topple an object, what is undecided, and where it topples."""
    shown = rows[:MOST_BARS]
    end = max(row["end_of_search"] for row in shown)
    known = [value for row in shown for value in (row["topples_from"], row["undecided_from"], asked) if value]
    right = min(end, 1.15 * max(known), 3 * asked if asked else math.inf) if known else end
    figure, axes = pyplot.subplots(figsize=(8, 1.1 + 0.2 * len(shown)), layout="constrained")
    for i, row in enumerate(shown):
        searched = min(row["end_of_search"], right)
        topples = row["topples_from"] if row["topples_from"] is not None else math.inf
        unknown = row["undecided_from"] if row["undecided_from"] is not None else math.inf
        stands = min(topples, unknown, searched)
        axes.barh(i, stands, color=REGIONS[STANDS][2], edgecolor="0.4", linewidth=0.4)
        if unknown < topples:
            axes.barh(i, min(topples, searched) - unknown, left=unknown, color=REGIONS[UNDECIDED][2])
        if topples < right:
            axes.barh(i, right - topples, left=topples, color=REGIONS[TOPPLES][2])
        if asked and row["verdict"] not in ("topples", "undecided") and topples < asked:  # it stands between others
            first, last = asked * (row["factor_below"] or 0), min(asked * (row["factor_above"] or math.inf), searched)
            axes.barh(i, last - first, left=first, color=REGIONS[STANDS][2])
        if row["end_of_search"] < right:
            axes.barh(i, right - row["end_of_search"], left=row["end_of_search"], color="white", edgecolor="0.6",
                      hatch="///", linewidth=0)
    axes.set_yticks(np.arange(len(shown)), [row["title"] for row in shown], fontsize=8)
    axes.set_xlim(0, right)
    axes.set_ylim(len(shown) - 0.4, -0.6)
    axes.set_xlabel(f"{measure} [g]", fontsize=9)
    if asked:
        axes.axvline(asked, color="black", linewidth=1.2, linestyle=(0, (4, 2)))
    handles = [Patch(facecolor=REGIONS[STANDS][2], edgecolor="0.4", label="not found to topple"),
               Patch(color=REGIONS[TOPPLES][2], label="from the lowest strength that topples it on")]
    if any(row["undecided_from"] is not None for row in shown):
        handles.append(Patch(color=REGIONS[UNDECIDED][2], label="undecided"))
    if any(row["end_of_search"] < right for row in shown):
        handles.append(Patch(facecolor="white", edgecolor="0.6", hatch="///", label="not searched"))
    if asked:
        handles.append(Line2D([], [], color="black", linewidth=1.2, linestyle=(0, (4, 2)), label="asked"))
    axes.legend(handles=handles, fontsize=8, loc="lower left", bbox_to_anchor=(0, 1), ncols=len(handles), frameon=False)
    for side in ("top", "right"):
        axes.spines[side].set_visible(False)
    picture = io.StringIO()
    with matplotlib.rc_context({"svg.fonttype": "none", "svg.hashsalt": "overturn"}):
        figure.savefig(picture, format="svg", metadata={"Date": None})
    pyplot.close(figure)
    svg = picture.getvalue()
    return svg[svg.index("<svg"):]


def widths_of(answers):
    """Returns how wide the first object must be to stand in all cases, and in nine of ten."""
    least = answers["least_widths"]
    if least is None:
        return None
    values = least["safe_from"]
    most = math.floor(0.9 * len(values))
    name = f"Object {least['object']}" if least["object"].isdigit() else least["object"]
    return {"object": name, "width": least["width"], "end": least["end_of_search"], "step": least["step_of_search"], "cases": len(values),
            "all": values[-1], "most": values[most - 1] if 0 < most < len(values) else None, "most_cases": most}


def page_of(answers):
    """Returns the page, as a text."""
    rows = answers["objects"]
    for row, title in zip(rows, titles_of(rows)):
        row["title"] = title
    for row, description in zip(rows, descriptions_of(rows)):
        row["description"] = description
    motion = answers["motion"]
    is_floor = answers["motion_of"] == "floor"
    measure = "peak floor acceleration (PFA)" if is_floor else "peak ground acceleration (PGA)"
    pulse = f"pulse of {motion['shape']}" if "shape" in motion else f"{motion.get('pulse', '').replace('_', '-')} pulse"
    text = (f"{pulse}, period {', '.join(f'{each:g}' for each in motion['periods'])} s"
            if "pulse" in motion else f"{len(motion['records'])} record{'s' * (len(motion['records']) > 1)}: {', '.join(motion['records'])}")
    is_asked = rows[0]["verdict"] is not None
    largest = max(row["pga"] for row in rows) if is_asked else None
    has_one = answers["pga"] is not None or len(motion.get("records", [])) == 1  # strength of all motions
    asked = largest if has_one else None
    has_slip = "slides_from" in rows[0]
    environment = Environment(autoescape=True)
    environment.filters.update(number=number, above_search=above_search, tilt=tilt, slide=slide,
                               width=lambda value: f"{math.ceil(value * 1e4) / 1e4:.4f}", strength=lambda value: f"{number(value, '')} g")
    measured = (f"scale {answers['scale']:g} of every record, {'' if has_one else 'up to '}{largest:.4g} g"
                if answers["scale"] else f"{measure} {answers['pga']} g")
    return environment.from_string(PAGE).render(
        made_by=Markup(MADE_BY), title="Which objects topple?", motion=text, strength=measured if is_asked else "", asked=is_asked, objects=rows,
        toppling=[row for row in rows if row["verdict"] == "topples"],
        near=[row for row in rows if row["factor_below"] or (row["factor_above"] or math.inf) < 1.1],
        undecided=[row for row in rows if row["verdict"] == "undecided"],
        unsettled=[row for row in rows if row["undecided_from"] is not None and row["verdict"] != "undecided"],
        fine=answers["search"] == "fine", open_ended=[row for row in rows if row["topples_from"] is None],
        most_cases=max(row["cases"] for row in rows), has_slip=has_slip, picture=Markup(draw(rows, asked, measure)),
        assumptions=(*ASSUMPTIONS, WITH_FRICTION if has_slip else WITHOUT_FRICTION), warnings=answers["warnings"],
        version=answers["program_version"], table=answers["table"], measure=measure, widths=widths_of(answers), is_floor=is_floor, gravity=answers["gravity"],
        topples=REGIONS[TOPPLES][2])


def read_arguments(argv):
    parser = parser_of("report", __doc__, EXAMPLE)
    parser.add_argument("file", metavar="OBJECTS.csv|ANSWERS.json",
                        help="table of objects, or what overturn assess --json has written")
    parser.add_argument("-o", "--output", metavar="OUT", help="page (default: FILE.html in the working directory)")
    arguments, options = parser.parse_known_args(argv)
    if options and arguments.file.endswith(".json"):
        parser.error(f"{options[0]} is an option for a table of objects")
    arguments.output = arguments.output or pathlib.Path(arguments.file).stem + ".html"
    return arguments, options


def main(argv=None):
    arguments, options = read_arguments(argv)
    page = page_of(answers_in(arguments.file, options))
    write_text(arguments.output, page, "a report of overturn", lambda beginning: MADE_BY.encode() in beginning)
    print(arguments.output)
