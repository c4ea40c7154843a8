#!/usr/bin/python3
"""contacts_report.py DIRECTORY ROUND.csv...: puts the rounds together and writes contacts.csv,
contacts.md (one table per case) and contacts.svg (speed against error, by gnuplot) into the directory.
Costs are the least of all rounds: what else a machine does only adds to them. Columns and errors are
those of contact_measure.h."""

import csv
import math
import subprocess
import sys

ENGINES = {"poinsot": ("Poinsot", "#c1272d"), "bullet": ("Bullet", "#0072b2"), "dart": ("DART", "#009e73"),
           "mujoco": ("MuJoCo", "#e69f00"), "ode": ("ODE", "#7b4ea3")}
# case: title, what the error is, what stands under "over time" and under "extra"
ACCURACY = {
    "tower10": ("Tower of 10 unit boxes, 60 s", "displacement [m]", "over time [m]", "top drift [m]"),
    "heavy_top": ("Unit boxes of 1, 10, 100, 1000 kg, heaviest on top, 10 s", "displacement [m]",
                  "over time [m]", "top drift [m]"),
    "alternating30": ("Tower of 30, 1 and 1000 kg in turn, 10 s", "displacement [m]", "over time [m]",
                      "top drift [m]"),
    "alternating30_1e4": ("Tower of 30, 1 and 10 000 kg in turn, 10 s", "displacement [m]", "over time [m]",
                          "top drift [m]"),
    "incline_stick": ("Box that sticks on 20°, μ 0.5, 8 azimuths, 10 s", "drift [m]", "over time [m]",
                      "spread [m]"),
    "incline_slide": ("Slab that slides down 30°, μ 0.5, 24 azimuths, 2 s", "distance [relative]", "",
                      "spread [relative]"),
    "sliding_stop": ("Box from 5 m/s to its stop, μ 0.3", "distance [m]", "", "lift-off [m]"),
    "slip_to_roll": ("Sphere from 7 m/s slip to roll, μ 0.2, 2 s", "distance [m]", "", "speed error [m/s]"),
}
COSTS = ("cpu_us_per_s_body", "ms_mean", "ms_median", "ms_p99")
ERROR_FLOOR = 1e-12  # an error below it is drawn there


def read_rounds(paths):
    """({(case, engine, setting): row}, columns), in the order of the first round."""
    found, columns = {}, []
    for path in paths:
        with open(path, newline="") as file:
            for row in csv.DictReader(file):
                if row["case"] == "case":  # a further header
                    continue
                columns = list(row)
                found.setdefault((row["case"], row["engine"], row["setting"]), []).append(row)
    rows = {}
    for key, same in found.items():
        rows[key] = dict(same[0])
        for cost in COSTS:
            values = [float(row[cost]) for row in same if row[cost]]
            if values:
                rows[key][cost] = f"{min(values):.4g}"
    return rows, columns


def write_csv(path, rows, columns):
    with open(path, "w", newline="") as file:
        writer = csv.DictWriter(file, columns, lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows.values())


def number(row, column, digits=3):
    return f"{float(row[column]):.{digits}g}" if row[column] else "–"


def status(row):
    return f"cut at {number(row, 'reached_s')} s" if row["status"] == "cut" else row["status"]


def line(cells):
    return "| " + " | ".join(cells) + " |"


def accuracy_table(case, rows):
    title, error, over_time, extra = ACCURACY[case]
    heads = ["engine", "setting", "status", "CPU µs per s and body", error, extra, "penetration [m]"]
    if over_time:
        heads.insert(5, over_time)
    lines = [f"## {case}: {title}", "", line(heads), "|---" * len(heads) + "|"]
    for row in rows:
        cells = [ENGINES[row["engine"]][0], row["setting"], status(row), number(row, "cpu_us_per_s_body"),
                 number(row, "error"), number(row, "extra"), number(row, "penetration_max_m")]
        if over_time:
            cells.insert(5, number(row, "error_over_time"))
        lines.append(line(cells))
    return lines


def pile_table(case, rows):
    heads = ["engine", "setting", "status", "ms a frame", "to Bullet", "median", "p99", "deepest [mm]",
             "mean depth [mm]", "kinetic [J]", "lowest [m]", "lost", "MB"]
    bodies = next((row["bodies"] for row in rows if row["bodies"]), "?")
    # A run that was cut has other frames behind it: no ratio.
    bullet = next((float(row["ms_mean"]) for row in rows if row["engine"] == "bullet" and row["status"] == "ok"), None)
    lines = [f"## {case}: {bodies} bodies", "", line(heads), "|---" * len(heads) + "|"]
    for row in rows:
        depths = [f"{1e3 * float(row[c]):.3g}" if row[c] else "–"
                  for c in ("penetration_max_m", "penetration_mean_m")]
        ratio = f"{float(row['ms_mean']) / bullet:.2f}" if bullet and row["status"] == "ok" else "–"
        lines.append(line([ENGINES[row["engine"]][0], row["setting"], status(row), number(row, "ms_mean"), ratio,
                           number(row, "ms_median"), number(row, "ms_p99"), *depths, number(row, "kinetic_J"),
                           number(row, "lowest_m"), row["lost"] or "–", number(row, "rss_MB")]))
    return lines


def curves(rows, case):
    """{(engine, method): [(cost, error)]}, sorted by cost; the method is the setting without its step."""
    found = {}
    for row in rows:
        if row["case"] == case and row["error"] and not math.isinf(float(row["error"])):
            method = row["setting"].rpartition(" ")[0] or row["setting"]
            found.setdefault((row["engine"], method), []).append(
                (float(row["cpu_us_per_s_body"]), max(float(row["error"]), ERROR_FLOOR)))
    return {key: sorted(points) for key, points in found.items()}


def draw(path, rows):
    cases = [case for case in ACCURACY if curves(rows, case)]
    if not cases:
        return
    across = min(2, len(cases))
    down = math.ceil(len(cases) / across)
    script = [f"set terminal svg size {760 * across},{420 * down} font 'sans,11' background 'white'",
              f"set output '{path}'", f"set multiplot layout {down},{across}",
              "set logscale xy", "set format xy '10^{%T}'", "set grid lc rgb '#dddddd'",
              "set key outside right samplen 2 font ',9'", "set xlabel 'CPU time per body and simulated second [µs]'"]
    for case in cases:
        title, error, *_ = ACCURACY[case]
        script += [f'set title "{title}"', f'set ylabel "{error}"']
        plots, used = [], {}
        for n, ((engine, method), points) in enumerate(curves(rows, case).items()):
            name, color = ENGINES[engine]
            kind = used[engine] = used.get(engine, 0) + 1
            script += [f"$data{n} << EOD", *(f"{cost} {e}" for cost, e in points), "EOD"]
            plots.append(f"$data{n} with linespoints lc rgb '{color}' dt {kind} pt {kind + 3} ps 0.7 lw {2 if engine == 'poinsot' else 1} "
                         f"title '{name} {method}' noenhanced")
        script.append("plot " + ", ".join(plots))
    subprocess.run(["gnuplot"], input="\n".join(script) + "\n", text=True, check=True)


def main():
    directory, *paths = sys.argv[1:]
    rows, columns = read_rounds(paths)
    write_csv(f"{directory}/contacts.csv", rows, columns)
    lines = []
    for case in dict.fromkeys(key[0] for key in rows):
        of_case = [row for row in rows.values() if row["case"] == case]
        lines += (accuracy_table if case in ACCURACY else pile_table)(case, of_case) + [""]
    with open(f"{directory}/contacts.md", "w") as file:
        file.write("\n".join(lines))
    draw(f"{directory}/contacts.svg", list(rows.values()))


if __name__ == "__main__":
    main()
