#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""plot.py DIR: draws the figures whose CSV files `touchstone bench figures` left in DIR, as SVG.

figure8.svg, figure9.svg   time against the gap: by the number of vertices, by the shape
figure10.svg               time in each stage of the published search against the gap
error-verdicts.svg         time against wrong verdicts, a panel for each size of the gap
error-gaps.svg             share of wrong verdicts against the size of the gap
boundary-growth.svg        time of the whole Minkowski boundary against facets (`bench boundary`)
error-values.svg           time against the relative error of exit travel, distance and depth
scene.svg                  time a step against the number of bodies (`touchstone bench scene --svg`)
minkowski.svg              time of local sums against rotation (`touchstone bench minkowski --svg`)
"""
import collections
import csv
import math
import os
import sys

import matplotlib

matplotlib.use("svg")
matplotlib.rcParams["svg.hashsalt"] = "touchstone"  # the same file for the same numbers
matplotlib.rcParams["svg.fonttype"] = "none"  # text stays text: smaller, and searchable
matplotlib.rcParams["font.family"] = ["DejaVu Sans", "sans-serif"]
import matplotlib.lines  # noqa: E402
import matplotlib.pyplot as plt  # noqa: E402
import matplotlib.ticker  # noqa: E402

# Ours in one colour family and thick, others apart; the same everywhere.
STYLES = {
    "portal": ("#d62728", "-", "o", 2.4),
    "portal-float": ("#ff9896", "-", "s", 1.6),
    "phased": ("#e377c2", "-", "^", 1.4),
    "published": ("#8c564b", "--", "v", 1.4),
    "enhanced-gjk": ("#1f77b4", "-", "D", 1.6),
    "libccd-mpr": ("#2ca02c", "-", "P", 1.2),
    "libccd-mpr+support": ("#98df8a", "-", "X", 1.2),
    "libccd-gjk": ("#17becf", ":", "<", 1.2),
    "libccd-gjk+support": ("#9edae5", ":", ">", 1.2),
    "fcl-libccd": ("#9467bd", "-", "p", 1.2),
    "fcl-own": ("#c5b0d5", ":", "h", 1.2),
    "bullet-f64": ("#7f7f7f", "-.", "*", 1.2),
}


def style(engine):
    return STYLES.get(engine, ("black", ":", ".", 1.0))


def read(directory, name):
    path = os.path.join(directory, name)
    if not os.path.exists(path):
        return []
    with open(path, newline="") as file:
        return list(csv.DictReader(file))


def save(figure, directory, name):
    figure.savefig(os.path.join(directory, name), metadata={"Date": None})
    plt.close(figure)


def gap_axis(axis, gaps, threshold=1e-3):
    axis.set_xscale("symlog", linthresh=threshold, linscale=0.5)
    axis.set_xlim(min(gaps) * 1.2, max(gaps) * 1.2)
    axis.axvline(0.0, color="black", linewidth=0.6)
    ticks = [t for t in (-100, -1, -0.01, 0, 0.01, 1, 100) if min(gaps) <= t <= max(gaps)]
    axis.set_xticks(ticks)
    axis.set_xticklabels([f"{t:g}" for t in ticks])
    axis.minorticks_off()
    axis.grid(True, which="major", color="#dddddd", linewidth=0.5)


def legend_below(figure, handles, labels, columns):
    figure.legend(handles, labels, loc="lower center", ncol=columns, frameon=False, fontsize=8)


def time_against_gap(directory, source, target, panel_key, panel_title, title):
    rows = read(directory, source)
    if not rows:
        return
    panels = list(dict.fromkeys(row[panel_key] for row in rows))
    columns = min(2, len(panels))
    lines = math.ceil(len(panels) / columns)
    figure, axes = plt.subplots(lines, columns, figsize=(10, 3.4 * lines + 0.8), squeeze=False)
    handles = {}
    for axis, panel in zip(axes.flat, panels):
        curves = collections.defaultdict(list)
        for row in rows:
            if row[panel_key] == panel:
                curves[row["engine"]].append((float(row["gap"]), float(row["median_ns"])))
        for engine, points in curves.items():
            points.sort()
            colour, dash, _, width = style(engine)
            (handles[engine],) = axis.plot(*zip(*points), dash, color=colour, linewidth=width)
        axis.set_yscale("log")
        gap_axis(axis, [gap for points in curves.values() for gap, _ in points])
        axis.set_title(panel_title(panel), fontsize=10)
        axis.set_xlabel("gap ℓ (negative: overlap)", fontsize=8)
        axis.set_ylabel("ns a query", fontsize=8)
        axis.tick_params(labelsize=8)
    for axis in list(axes.flat)[len(panels):]:
        axis.set_visible(False)
    figure.suptitle(title, fontsize=11)
    figure.tight_layout(rect=(0, 0.55 / figure.get_figheight(), 1, 1))
    legend_below(figure, handles.values(), handles.keys(), 6)
    save(figure, directory, target)


def figure_10(directory):
    rows = read(directory, "figure10.csv")
    if not rows:
        return
    stages = [key for key in rows[0] if key not in ("n", "gap")]
    gaps = [float(row["gap"]) for row in rows]
    colours = ["#dddddd", "#bbbbbb", "#1f77b4", "#ff7f0e", "#d62728"]
    figure, axis = plt.subplots(figsize=(8, 5))
    axis.stackplot(gaps, [[float(row[s]) / 1000.0 for row in rows] for s in stages],
                   labels=stages, colors=colours)
    gap_axis(axis, gaps)
    axis.set_ylim(bottom=0)
    axis.set_xlabel("gap ℓ (negative: overlap)")
    axis.set_ylabel("µs a query, accumulated")
    axis.set_title(f"Time in each stage of the published search, n = {rows[0]['n']}, 200:100:100",
                   fontsize=11)
    handles, labels = axis.get_legend_handles_labels()
    figure.tight_layout(rect=(0, 0, 0.82, 1))
    figure.legend(handles[::-1], labels[::-1], loc="center right", frameon=False)
    save(figure, directory, "figure10.svg")


# Where a rate of zero is drawn: below the least that could have been seen. Engines
# that share it are drawn a little apart.
def drawn_rate(wrong, queries, floor, position):
    return wrong / queries if wrong > 0 else floor * 0.93**position


def error_verdicts(directory):
    rows = read(directory, "error-verdicts.csv")
    if not rows:
        return
    shapes = list(dict.fromkeys(row["shape"] for row in rows))
    sizes = sorted({abs(float(row["gap"])) for row in rows})
    shown = [s for s in sizes if s in (1e-12, 1e-9, 1e-6, 1e-3, 1.0)]
    figure, axes = plt.subplots(len(shapes), len(shown), sharey=True, squeeze=False,
                                figsize=(2.9 * len(shown) + 0.6, 3.2 * len(shapes) + 0.9))
    handles = {}
    for line, shape in enumerate(shapes):
        for column, size in enumerate(shown):
            axis = axes[line][column]
            points = collections.defaultdict(lambda: [0, 0, 0, []])
            for row in rows:
                if row["shape"] == shape and abs(float(row["gap"])) == size:
                    point = points[(row["engine"], row["tolerance"])]
                    point[0] += int(row["wrong"])
                    point[1] += int(row["undecided"])
                    point[2] += int(row["queries"])
                    point[3].append(float(row["median_ns"]))
            floor = min(0.3 / p[2] for p in points.values())
            order = list(dict.fromkeys(engine for engine, _ in points))
            for (engine, tolerance), (wrong, undecided, queries, times) in points.items():
                colour, _, marker, _ = style(engine)
                time = sum(times) / len(times)
                # Smaller for a looser tolerance, hollow where it could not tell.
                area = 18 if not tolerance else 8 + 3 * -math.log10(float(tolerance))
                if engine.startswith("portal"):
                    area = 70
                handles[engine] = axis.scatter(
                    time, drawn_rate(wrong, queries, floor, order.index(engine)), s=area, marker=marker, edgecolors=colour,
                    facecolors="none" if undecided > 0 else colour, linewidths=1.0, zorder=3)
            axis.axhspan(floor * 0.3, floor * 1.5, color="#e8f5e9", zorder=0)
            axis.set_xscale("log")
            axis.set_yscale("log")
            axis.set_ylim(floor * 0.3, 1.5)
            axis.grid(True, which="major", color="#dddddd", linewidth=0.5)
            axis.tick_params(labelsize=7)
            if line == 0:
                axis.set_title(f"|ℓ| = {size:g}", fontsize=10)
            if line == len(shapes) - 1:
                axis.set_xlabel("ns a query", fontsize=8)
            if column == 0:
                axis.set_ylabel(f"{shape}\nshare of wrong verdicts\n(green: none)", fontsize=8)
    figure.suptitle("Fast is left, right is the green band, both is its left end\n"
                    "(markers grow as the tolerance tightens; hollow: some answers undecided)",
                    fontsize=10)
    figure.tight_layout(rect=(0, 0.5 / figure.get_figheight(), 1, 1))
    solid = {e: matplotlib.lines.Line2D([], [], linestyle="", color=style(e)[0],
                                        marker=style(e)[2], markersize=6) for e in handles}
    legend_below(figure, solid.values(), solid.keys(), 6)
    save(figure, directory, "error-verdicts.svg")


def error_gaps(directory):
    rows = [r for r in read(directory, "error-verdicts.csv") if r["is_best"] == "1"]
    if not rows:
        return
    shapes = list(dict.fromkeys(row["shape"] for row in rows))
    figure, axes = plt.subplots(1, len(shapes), sharey=True, squeeze=False,
                                figsize=(5.2 * len(shapes), 5.2))
    handles = {}
    for axis, shape in zip(axes[0], shapes):
        counts = collections.defaultdict(lambda: collections.defaultdict(lambda: [0, 0]))
        for row in rows:
            if row["shape"] == shape:
                count = counts[row["engine"]][abs(float(row["gap"]))]
                count[0] += int(row["wrong"])
                count[1] += int(row["queries"])
        floor = min(0.3 / q for c in counts.values() for _, q in c.values())
        for position, (engine, by_size) in enumerate(counts.items()):
            colour, dash, marker, width = style(engine)
            sizes = sorted(by_size)
            rates = [drawn_rate(*by_size[s], floor, position) for s in sizes]
            (handles[engine],) = axis.plot(sizes, rates, dash, color=colour, marker=marker,
                                           markersize=4, linewidth=width)
        axis.axhspan(floor * 0.3, floor * 1.5, color="#e8f5e9", zorder=0)
        axis.set_xscale("log")
        axis.set_yscale("log")
        axis.set_ylim(floor * 0.3, 1.5)
        axis.grid(True, which="major", color="#dddddd", linewidth=0.5)
        axis.set_title(f"{shape}, n = {rows[0]['n']}", fontsize=10)
        axis.set_xlabel("|ℓ|, both sides of contact; the bodies' size is 200" if shape != "parallel"
                        else "|ℓ|, both sides of contact; the bodies' size is 100", fontsize=8)
    axes[0][0].set_ylabel("share of wrong verdicts (green: none)", fontsize=9)
    figure.suptitle("Wrong verdicts of each engine at its most accurate setting", fontsize=11)
    figure.tight_layout(rect=(0, 0.16, 1, 1))
    legend_below(figure, handles.values(), handles.keys(), 5)
    save(figure, directory, "error-gaps.svg")


def whole_decades(low, high):
    return 10.0 ** math.floor(math.log10(low)), 10.0 ** math.ceil(math.log10(high))


def error_values(directory):
    rows = [row for row in read(directory, "error-values.csv") if row["median_error"]]
    if not rows:
        return
    quantities = list(dict.fromkeys(row["quantity"] for row in rows))
    sizes = sorted({abs(float(row["gap"])) for row in rows})
    figure, axes = plt.subplots(len(sizes), len(quantities), sharex="col", sharey="row",
                                squeeze=False,
                                figsize=(4.0 * len(quantities) + 0.6, 2.3 * len(sizes) + 1.1))
    handles = {}
    for line, size in enumerate(sizes):
        for column, quantity in enumerate(quantities):
            axis = axes[line][column]
            for row in rows:
                if row["quantity"] != quantity or abs(float(row["gap"])) != size:
                    continue
                engine, time = row["engine"], float(row["median_ns"])
                colour, _, marker, _ = style(engine)
                low = max(float(row["median_error"]), 1e-17)
                high = max(float(row["greatest_error"]), 1e-17)
                axis.plot([time, time], [low, high], "-", color=colour, linewidth=0.8, alpha=0.6)
                axis.plot([time], [high], "_", color=colour, markersize=6)
                axis.scatter(time, low, marker=marker, color=colour, zorder=3,
                             s=60 if engine == "portal" else 24)
                handles[engine] = matplotlib.lines.Line2D([], [], linestyle="", color=colour,
                                                          marker=marker, markersize=6)
            # Half a unit in the last place of the bodies' size, over the value.
            axis.axhline(200 * 2.0**-53 / size, color="black", linewidth=0.7, linestyle=":")
            axis.set_xscale("log")
            axis.set_yscale("log")
            axis.grid(True, which="major", color="#dddddd", linewidth=0.5)
            axis.tick_params(labelsize=7, which="both")
            axis.xaxis.set_minor_formatter(matplotlib.ticker.NullFormatter())
            if line == 0:
                axis.set_title(quantity.replace("exit_travel", "exit travel α"), fontsize=10)
            if line == len(sizes) - 1:
                axis.set_xlabel("ns a query", fontsize=8)
            if column == 0:
                axis.set_ylabel(f"|ℓ| = {size:g}\nrelative error", fontsize=8)
    for axis in axes[0]:
        axis.set_xlim(*whole_decades(*axis.get_xlim()))
    for axis in axes[:, 0]:
        axis.set_ylim(*whole_decades(*axis.get_ylim()))
    figure.suptitle("Time against error of what engines report, each tolerance a mark: median, and "
                    "a bar up to the greatest\n(dotted: one rounding of a coordinate)", fontsize=10)
    figure.tight_layout(rect=(0, 0.6 / figure.get_figheight(), 1, 1))
    legend_below(figure, handles.values(), handles.keys(), 6)
    save(figure, directory, "error-values.svg")


def panels_of_curves(directory, name, rows, panel, curve, x, y, height, colours, labels, title):
    """One panel for each value of `panel`, in it one curve of y over x for each value of `curve`."""
    panels = list(dict.fromkeys(row[panel] for row in rows))
    figure, axes = plt.subplots(1, len(panels), figsize=(10, height), squeeze=False, sharey=True)
    handles = {}
    for axis, value in zip(axes.flat, panels):
        curves = collections.defaultdict(list)
        for row in rows:
            if row[panel] == value:
                curves[row[curve]].append((float(row[x]), float(row[y])))
        for label, points in curves.items():
            (handles[label],) = axis.plot(*zip(*sorted(points)), "-o", markersize=3,
                                          color=colours.get(label, "black"))
        axis.set_xscale("log")
        axis.set_yscale("log")
        axis.grid(True, which="major", color="#dddddd", linewidth=0.5)
        axis.set_title(value, fontsize=10)
        axis.set_xlabel(labels[0], fontsize=8)
        axis.tick_params(labelsize=8)
    axes[0, 0].set_ylabel(labels[1], fontsize=8)
    figure.suptitle(title, fontsize=11)
    figure.tight_layout(rect=(0, 0.1, 1, 1))
    legend_below(figure, handles.values(), handles.keys(), 4)
    save(figure, directory, name)


def scene(directory):
    rows = [row for row in read(directory, "scene.csv") if " without " not in row["engine"]]
    if not rows:
        return
    colours = {"touchstone": "#d62728", "touchstone threads": "#ff9896", "fcl": "#9467bd",
               "bullet-f64": "#7f7f7f"}
    panels_of_curves(directory, "scene.svg", rows, "motion", "engine", "bodies",
                     "median_ms_per_step", 4.0, colours, ("bodies", "ms a step"),
                     "Steps of scenes of hulls of 100 vertices at constant density")


def boundary_growth(directory):
    rows = read(directory, "boundary-growth.csv")
    if not rows:
        return
    facets = [float(row["facets"]) for row in rows]
    seconds = [float(row["seconds"]) for row in rows]
    exponent = float(rows[0]["exponent"])
    middle = math.exp(sum(map(math.log, seconds)) / len(rows))
    centre = math.exp(sum(map(math.log, facets)) / len(rows))
    figure, axis = plt.subplots(figsize=(6, 4))
    axis.plot(facets, [middle * (f / centre) ** exponent for f in facets], "--", color="#7f7f7f",
              linewidth=1.0, label=f"facets to the {exponent:.2f}")
    axis.plot(facets, seconds, "o", color="#d62728", label="torus / torus")
    axis.set_xscale("log")
    axis.set_yscale("log")
    axis.grid(True, which="major", color="#dddddd", linewidth=0.5)
    axis.set_xlabel("facets of the convolution")
    axis.set_ylabel("seconds")
    axis.set_title("Time of the whole boundary against facets", fontsize=11)
    axis.legend(frameon=False)
    figure.tight_layout()
    save(figure, directory, "boundary-growth.svg")


def minkowski(directory):
    rows = [row for row in read(directory, "minkowski.csv") if "-depth" not in row["scene"]]
    if not rows:
        return
    colours = {"gap-filling": "#d62728", "sphere-hierarchy": "#9467bd", "brute-force": "#7f7f7f",
               "full": "black"}
    panels_of_curves(directory, "minkowski.svg", rows, "scene", "builder", "rotation_deg",
                     "median_ms", 3.6, colours, ("degrees a frame", "ms an update"),
                     "Local Minkowski sums: time of an update against rotation")


def main():
    if len(sys.argv) != 2 or not os.path.isdir(sys.argv[1]):
        sys.exit(__doc__)
    directory = sys.argv[1]
    time_against_gap(directory, "figure8.csv", "figure8.svg", "n",
                     lambda n: f"n = {n}", "Time against the gap, ellipsoids 200:100:100 "
                     "(the paper's Figure 8)")
    time_against_gap(directory, "figure9.csv", "figure9.svg", "shape",
                     lambda shape: shape, "Time against the gap by shape, n = 1000 "
                     "(the paper's Figure 9)")
    figure_10(directory)
    error_verdicts(directory)
    error_gaps(directory)
    error_values(directory)
    scene(directory)
    boundary_growth(directory)
    minkowski(directory)


if __name__ == "__main__":
    main()
