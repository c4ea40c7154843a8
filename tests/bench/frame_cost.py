#!/usr/bin/env python3
"""frame_cost.py BIN [--frames N] [--domain N]: what a frame of 1000 bodies costs with no reader, with
one reader and with a stopped one.

Generates two scenes, runs `poinsotd run SCENE --frames N --json` with `poinsot watch --json` as the
reader (stopped by SIGSTOP after a second), and prints per frame the CPU time of each layer and of
publishing. `rest`: 1000 boxes that lie apart on the floor; `free`: 1000 spheres in free flight. Also:
time from the start of the process until its first line, and resident memory.
BIN: directory of poinsotd and poinsot."""

import argparse
import json
import os
import signal
import subprocess
import tempfile
import time

LAYERS = ("presentation", "collision", "contact", "simulation", "publishing")


def scene(kind, count=1000):
    lines = ["world: frame_cost", "bodies:"]
    if kind == "rest":
        lines.append("  - {name: floor, static: true, shape: {half_space: {normal: [0, 0, 1]}}}")
    for i in range(count):
        x, y = i % 32, i // 32
        if kind == "rest":
            lines.append(f"  - {{name: box_{i}, shape: {{box: [0.4, 0.4, 0.4]}}, density: 500, "
                         f"position: [{x}, {y}, 0.2]}}")
        else:
            lines.append(f"  - {{name: ball_{i}, shape: {{sphere: 0.2}}, density: 500, "
                         f"position: [{x}, {y}, 0], linear_velocity: [0, 0, 5], "
                         f"angular_velocity: [0, {i % 7}, 1]}}")
    return "\n".join(lines) + "\n"


def resident_mb(pid):
    with open(f"/proc/{pid}/status") as status:
        for line in status:
            if line.startswith("VmRSS"):
                return int(line.split()[1]) / 1024
    return 0.0


def ready_seconds(arguments, path):
    """From the start of the process to its first line, and memory a second later."""
    begin = time.monotonic()
    daemon = subprocess.Popen([f"{arguments.bin}/poinsotd", "run", path, "--domain",
                               str(arguments.domain)], stdout=subprocess.PIPE,
                              stderr=subprocess.DEVNULL)
    daemon.stdout.readline()
    ready = time.monotonic() - begin
    time.sleep(1)
    memory = resident_mb(daemon.pid)
    daemon.terminate()
    daemon.communicate(timeout=10)
    return ready, memory


def run(arguments, path, reader):
    daemon = subprocess.Popen([f"{arguments.bin}/poinsotd", "run", path, "--json", "--frames",
                               str(arguments.frames), "--domain", str(arguments.domain)],
                              stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)
    watcher = None
    if reader != "none":
        watcher = subprocess.Popen([f"{arguments.bin}/poinsot", "watch", "--json", "--domain",
                                    str(arguments.domain)], stdout=subprocess.DEVNULL,
                                   stderr=subprocess.DEVNULL)
    time.sleep(1)
    if reader == "stopped":
        os.kill(watcher.pid, signal.SIGSTOP)
    out, _ = daemon.communicate(timeout=arguments.frames / 10 + 60)
    if watcher:
        watcher.kill()
        watcher.wait()
    return json.loads(out)


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("bin")
    parser.add_argument("--frames", type=int, default=600)
    parser.add_argument("--domain", type=int, default=179)
    arguments = parser.parse_args()
    for kind in ("rest", "free"):
        with tempfile.NamedTemporaryFile("w", suffix=".yaml") as file:
            file.write(scene(kind))
            file.flush()
            ready, memory = ready_seconds(arguments, file.name)
            print(f"{kind}: ready after {ready:.3f} s, resident {memory:.1f} MB")
            print("  CPU per frame [ms]  " + "".join(f"{layer:>14}" for layer in LAYERS) +
                  f"{'wall':>10}{'share of publishing':>22}")
            for reader in ("none", "one", "stopped"):
                summary = run(arguments, file.name, reader)
                frames = summary["frames"]
                costs = [1e3 * summary["cpu_s"][layer] / frames for layer in LAYERS]
                share = costs[-1] / (1e3 * summary["sim_time"] / frames)
                print(f"  reader: {reader:<12}" + "".join(f"{cost:14.4f}" for cost in costs) +
                      f"{1e3 * summary['wall_s'] / frames:10.3f}{100 * share:20.2f} %")


if __name__ == "__main__":
    main()
