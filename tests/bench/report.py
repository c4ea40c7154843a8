#!/usr/bin/python3
"""report.py DIRECTORY ROUND.csv...: puts the rounds together, by the median of the cost, and writes
speed_against_error.csv, .md (tables) and .svg (plot) into the directory.

The error of a row is the larger of orientation [rad] and position [m]. The first setting that an engine
reports for a case is its default."""

import csv
import math
import statistics
import sys

import matplotlib
matplotlib.use("svg")
import matplotlib.pyplot as plt

ENGINES = {"poinsot": ("Poinsot", "#c1272d"), "bullet": ("Bullet", "#0072b2"),
           "dart": ("DART", "#009e73"), "mujoco": ("MuJoCo", "#e69f00"),
           "ode": ("ODE", "#7b4ea3"), "simbody": ("Simbody", "#555555")}
CASES = {"racket": "racket, 20 s", "tumble": "tumble, 20 s", "crowd": "crowd, 10 s",
         "pushed": "pushed, 20 s", "falling": "falling, 10 s", "spring": "spring, 10 s"}
PANELS = {"racket": "Tennis racket: ω₀ = (0.001, 5, 0.001), 20 s", "tumble": "Tumble: ω₀ = (1, 3, 2), 20 s",
          "crowd": "1000 free bodies under gravity, 10 s",
          "pushed": "Tumble under a torque in W and a force in B, 20 s"}
FLOOR = 1e-16  # an error below it is drawn there
LOST = 1.0     # [rad, m] from here on the motion is another one


def read_rounds(paths):
    """{(engine, case): {setting: (orientation, position, cost)}}, in the order of the first round."""
    rows = {}
    for path in paths:
        with open(path, newline="") as file:
            for engine, case, setting, *numbers in csv.reader(file):
                rows.setdefault((engine, case), {}).setdefault(setting, []).append(
                    [float(number) for number in numbers])
    return {key: {setting: (max(row[0] for row in found), max(row[1] for row in found),
                            statistics.median(row[2] for row in found))
                  for setting, found in settings.items()} for key, settings in rows.items()}


def error(row):
    worst = max(row[0], row[1])
    return math.inf if math.isnan(row[0]) or math.isnan(row[1]) else worst


def write_csv(path, rows):
    with open(path, "w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["engine", "case", "setting", "orientation_error_rad", "position_error_m",
                         "cpu_us_per_s"])
        for (engine, case), settings in rows.items():
            for setting, row in settings.items():
                writer.writerow([engine, case, setting, *(f"{x:.4g}" for x in row)])


def cost_text(us):
    return f"{us / 1000:.2g} ms" if us >= 1000 else f"{us:.0f} µs" if us >= 10 else f"{us:.2g} µs"


def cell(row):
    e = error(row)
    size = "lost" if e >= LOST else "exact" if e == 0 else f"{e:.2g}" if e >= 0.01 else f"{e:.0e}"
    return f"{size} · {cost_text(row[2])}"


def table(rows, choose):
    lines = ["| | " + " | ".join(CASES.values()) + " |", "|---" * (len(CASES) + 1) + "|"]
    for engine, (name, _) in ENGINES.items():
        cells = [cell(choose(rows[engine, case])) if (engine, case) in rows else "–"
                 for case in CASES]
        lines.append(f"| {name} | " + " | ".join(cells) + " |")
    return "\n".join(lines)


def tables(rows):
    def default(settings):
        return next(iter(settings.values()))

    def best(settings):
        least = min(error(row) for row in settings.values())
        return min((row for row in settings.values() if error(row) <= 1.5 * least),
                   key=lambda row: row[2])

    return (f"As the engines come, 60 outputs per second (fixed steps: 1/60 s):\n\n"
            f"{table(rows, default)}\n\n"
            f"The cheapest setting of each within 1.5 times its smallest error (steps down to 1/10 020 s, of the crowd to "
            f"1/1020 s; accuracies to 1e-12; settings that take more than 15 s are left out):\n\n"
            f"{table(rows, best)}\n")


def curves(rows, case):
    """[(engine, label, [(cost, error)], default point)]; methods of an engine with equal errors are one."""
    result = []
    for engine, (name, _) in ENGINES.items():
        settings = rows.get((engine, case), {})
        methods = {}
        for setting, row in settings.items():
            method, _, _ = setting.rpartition(" ")
            methods.setdefault(method, []).append((row[2], max(error(row), FLOOR)))
        drawn = {}
        for method, points in methods.items():
            same = next((other for other in drawn if len(drawn[other]) == len(points) and all(
                abs(math.log(a[1] / b[1])) < 0.1 for a, b in zip(drawn[other], points))), None)
            if same is None:
                drawn[method] = points
            else:
                drawn[f"{same}, {method}"] = drawn.pop(same)
        for method, points in drawn.items():
            plain = "" if method == "default" else " " + method
            result.append((engine, name + plain, sorted(points),
                           points[0] if method.startswith(next(iter(methods))) else None))
    return result


def spread(wanted, gap):
    """Positions up to 1 as near to the wanted ones as a distance of `gap` allows, in the same order."""
    groups = []  # [sum of wanted minus offset, members]
    for i in sorted(range(len(wanted)), key=lambda i: wanted[i]):
        groups.append([wanted[i], [i]])
        while len(groups) > 1:
            (upper, members), (lower, others) = groups[-1], groups[-2]
            top = lower / len(others) + gap * len(others)
            if upper / len(members) >= top:
                break
            groups[-2:] = [[lower + upper - gap * len(others) * len(members), others + members]]
    positions = [0.0] * len(wanted)
    for total, members in groups:
        for k, i in enumerate(members):
            positions[i] = total / len(members) + k * gap
    top = 1.0
    for i in sorted(range(len(wanted)), key=lambda i: -positions[i]):
        positions[i] = min(positions[i], top)
        top = positions[i] - gap
    return positions


def draw_panel(axes, found, title):
    axes.set(xscale="log", yscale="log", title=title, xlim=(1, 1e5), ylim=(FLOOR / 3, 10))
    axes.set_xlabel("CPU time per body and simulated second [µs]")
    axes.set_ylabel("largest error [rad, m]")
    axes.grid(True, which="major", color="#dddddd", linewidth=0.6)
    axes.axhspan(LOST, 10, color="#f2f2f2", zorder=0)
    count = {}
    ends = []
    for engine, label, points, default in found:
        color = ENGINES[engine][1]
        style = ["-", "--", ":", "-.", (0, (5, 1, 1, 1)), (0, (1, 2)), (0, (8, 2))][
            count.setdefault(engine, 0) % 7]
        marker = "osD^vPX"[count[engine] % 7]
        count[engine] += 1
        width = 1.8 if engine == "poinsot" else 1.2
        axes.plot(*zip(*points), color=color, linestyle=style, linewidth=width, marker=marker,
                  markersize=4)
        if default:
            axes.plot(*default, "o", markersize=10, markerfacecolor="none", color=color)
        ends.append((label, points[-1], color))
    # Labels stand in a column at the right, each with a line to its curve's end.
    transform = axes.transData + axes.transAxes.inverted()
    wanted = [transform.transform(end)[1] for _, end, _ in ends]
    for (label, end, color), y in zip(ends, spread(wanted, 0.048)):
        axes.annotate(label, xy=end, xytext=(1.03, y), textcoords="axes fraction", color=color,
                      fontsize=8.5, va="center", annotation_clip=False,
                      arrowprops={"arrowstyle": "-", "color": color, "linewidth": 0.5, "alpha": 0.5,
                                  "relpos": (0, 0.5), "shrinkA": 0, "shrinkB": 3})


def draw(path, rows):
    plt.rcParams.update({"font.size": 10, "svg.hashsalt": "poinsot", "axes.titlesize": 11})
    figure, panels = plt.subplots(2, 2, figsize=(16, 11))
    for axes, (case, title) in zip(panels.flat, PANELS.items()):
        draw_panel(axes, curves(rows, case), title)
    figure.subplots_adjust(left=0.05, right=0.845, top=0.96, bottom=0.08, wspace=0.66, hspace=0.24)
    figure.text(0.5, 0.015, "A ring marks the default. In the grey band the motion is lost.",
                ha="center", fontsize=10)
    figure.savefig(path, metadata={"Date": None})


def main():
    directory, *paths = sys.argv[1:]
    rows = read_rounds(paths)
    write_csv(f"{directory}/speed_against_error.csv", rows)
    with open(f"{directory}/speed_against_error.md", "w") as file:
        file.write(f"\n{tables(rows)}\n")
    draw(f"{directory}/speed_against_error.svg", rows)


if __name__ == "__main__":
    main()
