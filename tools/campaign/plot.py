#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""plot.py DIR: draws DIR/travel.svg and DIR/errors.svg from the CSV files of `touchstone fuzz --report`.

travel.svg   share of wrong verdicts against the signed travel from contact, a line an engine
errors.svg   shares of distances and depths by relative error, a bar an engine
"""
import collections
import csv
import os
import sys

import matplotlib

matplotlib.use("svg")
matplotlib.rcParams["svg.hashsalt"] = "touchstone"  # the same file for the same numbers
matplotlib.rcParams["svg.fonttype"] = "none"
matplotlib.rcParams["font.family"] = ["DejaVu Sans", "sans-serif"]
import matplotlib.pyplot as plt  # noqa: E402


def read(directory, name):
    with open(os.path.join(directory, name), newline="") as file:
        return list(csv.DictReader(file))


def save(figure, directory, name):
    figure.savefig(os.path.join(directory, name), metadata={"Date": None}, bbox_inches="tight")
    plt.close(figure)


def draw_travel(directory):
    rows = read(directory, "travel.csv")
    if not rows:
        return
    classes = [name for name in rows[0] if name != "engine"]
    figure, axes = plt.subplots(figsize=(10, 5))
    for row in rows:
        places, shares = [], []
        for place, name in enumerate(classes):
            wrong, _, asked = row[name].partition(" of ")
            if asked:
                places.append(place)
                shares.append(100.0 * int(wrong) / int(asked))
        axes.plot(places, shares, marker="o", markersize=3, linewidth=1.2, label=row["engine"])
    axes.set_xticks(range(len(classes)), classes, rotation=60)
    axes.set_xlabel("signed travel from contact, over the size (negative: overlap)")
    axes.set_ylabel("wrong verdicts, %")
    axes.set_yscale("symlog", linthresh=0.01)
    axes.set_ylim(bottom=0.0)
    axes.legend(fontsize=7, loc="center left", bbox_to_anchor=(1.0, 0.5))
    save(figure, directory, "travel.svg")


def draw_errors(directory):
    rows = read(directory, "errors.csv")
    if not rows:
        return
    classes = list(rows[0])[4:]
    figure, panels = plt.subplots(1, 2, figsize=(12, 5), sharey=True)
    for panel, quantity in zip(panels, ["distance", "depth"]):
        sums = collections.OrderedDict()
        for row in rows:
            if row["quantity"] == quantity:
                counts = sums.setdefault(row["engine"], [0] * len(classes))
                for k, name in enumerate(classes):
                    counts[k] += int(row[name])
        left = [0.0] * len(sums)
        for k, name in enumerate(classes):
            widths = [100.0 * counts[k] / max(1, sum(counts)) for counts in sums.values()]
            color = plt.get_cmap("viridis_r")(k / max(1, len(classes) - 1))
            panel.barh(list(sums), widths, left=left, color=color, label=name)
            left = [a + b for a, b in zip(left, widths)]
        panel.set_xlabel(f"relative error of the {quantity}, % of queries")
    panels[1].legend(fontsize=7, loc="center left", bbox_to_anchor=(1.0, 0.5))
    save(figure, directory, "errors.svg")


if __name__ == "__main__":
    draw_travel(sys.argv[1])
    draw_errors(sys.argv[1])
