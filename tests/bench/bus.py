#!/usr/bin/env python3
"""What the bus costs and how late it is, with real processes on this host.

  bus.py --build DIR [--seconds S] [latency] [readers] [push] [paused] [late] [soak]

latency  poses from publish to receipt, p50 and p99, and frames lost: 100, 1000, 10 000 bodies at
         60 Hz, 100 000 at 10 Hz
readers  processor time of the daemon per frame with 0, 1 and 8 readers
push     from a push to its motion at a subscriber, in frames and in time
paused   processor time of a paused daemon with a reader and a client attached
late     a process that comes late: time until it has the scene of 1000 bodies and a first pose
soak     --seconds (1800) with clients that come and go: memory, late frames, files in /dev/shm

Without a name: all but soak. Bodies fly freely in a box of their own, without gravity, so that the
bus is what is measured.
"""

import argparse
import atexit
import json
import os
import pathlib
import random
import signal
import subprocess
import tempfile
import time

SHM = pathlib.Path("/dev/shm")


class Programs:
    def __init__(self, build, domain):
        self.daemon_path = build / "bin" / "poinsotd"
        self.client_path = build / "bin" / "poinsot"
        self.env = dict(os.environ, POINSOT_DOMAIN_ID=str(domain))

    def daemon(self, scene, *options):
        process = subprocess.Popen([self.daemon_path, "run", scene, "--json", *options], env=self.env,
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        atexit.register(process.kill)  # also if a measurement fails
        self.client("status", "--json")
        return process

    def start(self, *arguments):
        return subprocess.Popen([self.client_path, *arguments], env=self.env, text=True,
                                stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)

    def client(self, *arguments):
        done = subprocess.run([self.client_path, *arguments, "--timeout", "120s"], env=self.env, text=True,
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE, timeout=200)
        if done.returncode != 0:
            raise SystemExit(f"poinsot {' '.join(arguments)}: {done.stderr}")
        return done.stdout

    def status(self):
        return json.loads(self.client("status", "--json"))


def end(process):
    process.send_signal(signal.SIGTERM)
    return process.communicate(timeout=60)[0]


def scene(directory, bodies, rate=60):
    path = pathlib.Path(directory) / f"free{bodies}.yaml"
    side = max(1, round(bodies ** (1 / 3)))
    draw = random.Random(1)
    lines = [f"presentation: {{frame_rate: {rate}}}", "simulation: {gravity: [0, 0, 0]}", "bodies:"]
    for i in range(bodies):
        x, y, z = (10 * (i % side), 10 * (i // side % side), 10 * (i // side // side))
        spin = ", ".join(f"{draw.uniform(-3, 3):.3f}" for _ in range(3))
        lines.append(f"- {{name: b{i}, shape: {{box: [0.4, 0.2, 0.1]}}, density: 1000, "
                     f"position: [{x}, {y}, {z}], angular_velocity: [{spin}]}}")
    path.write_text("\n".join(lines) + "\n")
    return str(path)


def processor_seconds(pid):
    fields = pathlib.Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def resident_mb(pid):
    fields = pathlib.Path(f"/proc/{pid}/statm").read_text().split()
    return int(fields[1]) * os.sysconf("SC_PAGE_SIZE") / 1e6


def latency(run, directory, seconds):
    print("| bodies | frames/s | received | lost | p50 [ms] | p99 [ms] | frames late |")
    print("|---|---|---|---|---|---|---|")
    for bodies, rate in ((100, 60), (1000, 60), (10000, 60), (100000, 10)):
        daemon = run.daemon(scene(directory, bodies, rate))
        time.sleep(1)
        counting = run.start("hz", "--json", "-n", str(seconds))
        frames = seconds * rate
        ages = json.loads(run.client("delay", "--json", "-n", str(frames)).splitlines()[-1])
        counts = [json.loads(line) for line in counting.communicate(timeout=120)[0].splitlines()]
        late = run.status()["overruns"]
        end(daemon)
        received = sum(c["samples"] for c in counts)
        lost = counts[-1]["lost"]
        print(f"| {bodies} | {rate} | {received / seconds:.1f} /s | {lost} | {1e3 * ages['age']['p50']:.2f} | "
              f"{1e3 * ages['age']['p99']:.2f} | {late} |", flush=True)


def readers(run, directory, seconds):
    print("| bodies | readers | daemon's processor time per frame [ms] | of it publishing [ms] |")
    print("|---|---|---|---|")
    for bodies in (100, 1000, 10000):
        for count in (0, 1, 8):
            daemon = run.daemon(scene(directory, bodies))
            crowd = [run.start("hz", "--json") for _ in range(count)]
            time.sleep(2)
            before, cpu = run.status(), processor_seconds(daemon.pid)
            time.sleep(seconds)
            cpu = processor_seconds(daemon.pid) - cpu
            after = run.status()
            frames = after["frame"] - before["frame"]
            publishing = after["cpu_s"]["publishing"] - before["cpu_s"]["publishing"]
            for process in crowd:
                process.kill()
            end(daemon)
            print(f"| {bodies} | {count} | {1e3 * cpu / frames:.3f} | {1e3 * publishing / frames:.3f} |",
                  flush=True)


def push(run, directory, seconds):
    daemon = run.daemon(scene(directory, 100))
    seen = json.loads(run.client("delay", "--push", "b7", "--json", "-n", "200").splitlines()[-1])
    end(daemon)
    print("push to motion at a subscriber, 200 pushes:", json.dumps(seen), flush=True)


def paused(run, directory, seconds):
    daemon = run.daemon(scene(directory, 1000), "--paused")
    crowd = [run.start("watch", "--json"), run.start("hz", "--json")]
    time.sleep(2)
    cpu = processor_seconds(daemon.pid)
    time.sleep(seconds)
    cpu = processor_seconds(daemon.pid) - cpu
    for process in crowd:
        process.kill()
    end(daemon)
    print(f"paused, 1000 bodies, two clients: {100 * cpu / seconds:.2f} % of a processor", flush=True)


def late(run, directory, seconds):
    daemon = run.daemon(scene(directory, 1000))
    times = []
    for _ in range(20):
        start = time.monotonic()
        run.client("watch", "--json", "-n", "1")
        times.append(time.monotonic() - start)
    end(daemon)
    times.sort()
    print(f"late joiner, 1000 bodies, process started to first pose printed: median {times[10]:.2f} s, "
          f"worst of 20 {times[-1]:.2f} s", flush=True)


def soak(run, directory, seconds):
    daemon = run.daemon(scene(directory, 1000))
    print("| minute | frames | late | resident [MB] | files in /dev/shm | clients so far |")
    print("|---|---|---|---|---|---|")
    start, clients, line = time.monotonic(), 0, 0
    draw = random.Random(2)
    while time.monotonic() - start < seconds:
        if time.monotonic() - start >= 60 * line:
            status = run.status()
            print(f"| {line} | {status['frame']} | {status['overruns']} | {resident_mb(daemon.pid):.1f} | "
                  f"{len(list(SHM.iterdir()))} | {clients} |", flush=True)
            line += 1
        kind = draw.choice((("hz", "--json"), ("watch", "--json", "--match", "b1*", "--rate", "5"),
                            ("push", "b3", "--force", "1,0,0", "--for", "1s"), ("contacts", "--json")))
        process = run.start(*kind)
        time.sleep(draw.uniform(0.2, 2))
        process.send_signal(draw.choice((signal.SIGINT, signal.SIGTERM, signal.SIGKILL)))
        process.communicate(timeout=20)
        clients += 1
    end(daemon)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", type=pathlib.Path, required=True)
    parser.add_argument("--domain", type=int, default=91)
    parser.add_argument("--seconds", type=int, default=10)
    parser.add_argument("what", nargs="*")
    options = parser.parse_args()
    parts = {f.__name__: f for f in (latency, readers, push, paused, late, soak)}
    chosen = options.what or [name for name in parts if name != "soak"]
    run = Programs(options.build, options.domain)
    with tempfile.TemporaryDirectory() as directory:
        for name in chosen:
            print(f"\n{name}")
            parts[name](run, directory, options.seconds)


if __name__ == "__main__":
    main()
