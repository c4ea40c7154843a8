#!/usr/bin/env python3
"""A daemon and a client on two hosts with a bad network between them (bridge.py).

    network.py BIN FAULT_CLIENT [CASE...]

BIN holds poinsotd and poinsot, FAULT_CLIENT is tests/faults/fault_client. Prints a line for each case:
until the client's first frame [s]; frames that reached it of those that were advanced since, and the
longest row of missing ones; latency of a frame [ms]; pushes answered of those sent, and how long the
answers took [ms]; the daemon's overruns, and whether every frame's hash is that of the undisturbed
run. For the partition also how long after its end the first frame and the first answer came.
"""

import json
import os
import subprocess
import sys
import threading
import time

import bridge

WORLD, BODY, DOMAIN = "bouncing_balls", "ball_10", "70"
SECONDS = 14  # of a case


def lossless(net, client):
    time.sleep(SECONDS)


def loss_10_percent(net, client):
    net.drop = 0.1
    time.sleep(SECONDS)


def delay_50_ms(net, client):
    net.delay = 0.05
    time.sleep(SECONDS)


def reordered(net, client):
    net.jitter = 0.04
    time.sleep(SECONDS)


def all_of_these(net, client):
    net.drop, net.delay, net.jitter = 0.1, 0.05, 0.04
    time.sleep(SECONDS)


def partition_10_s(net, client):
    time.sleep(6)
    net.cut = True
    time.sleep(10)
    net.cut = False
    client.healed = time.monotonic() - client.start
    time.sleep(SECONDS - 4)


CASES = [lossless, loss_10_percent, delay_50_ms, reordered, all_of_these, partition_10_s]


class Client:
    """fault_client follow; its lines with the time at which they came."""

    def __init__(self, net, program, seconds):
        self.start = time.monotonic()
        self.healed = None
        self.frames, self.replies, self.lost = [], [], 0
        self.process = net.popen(1, ["stdbuf", "-oL", program, "follow", DOMAIN, WORLD, str(seconds), BODY],
                                 stdout=subprocess.PIPE, text=True)
        self.thread = threading.Thread(target=self.read)
        self.thread.start()

    def read(self):
        for line in self.process.stdout:
            kind, *fields = line.split()
            if kind == "frame":
                self.frames.append((int(fields[0]), int(fields[1]), float(fields[2]), float(fields[3])))
            elif kind == "reply":
                self.replies.append((float(fields[3]), float(fields[4]), int(fields[1])))
            else:
                self.lost += 1

    def end(self):
        self.process.wait()
        self.thread.join()


def status(net, directory):
    answer = net.popen(0, [f"{directory}/poinsot", "status", "--json", "--world", WORLD, "--domain", DOMAIN, "--listen", "lan"],
                       stdout=subprocess.PIPE)
    return json.loads(answer.communicate(timeout=30)[0])


def middle_and_worst(values):
    values = sorted(values)
    return f"{values[len(values) // 2]:.0f}/{values[len(values) * 99 // 100]:.0f}/{values[-1]:.0f}" if values else "-"


def report(case, client, overruns, hashes):
    numbers = sorted({f[0] for f in client.frames})
    if not numbers:
        print(f"{case.__name__:16} no frame came")
        return
    advanced = numbers[-1] - numbers[0] + 1
    hole = max((b - a - 1 for a, b in zip(numbers, numbers[1:])), default=0)
    same = all(hashes[f[0]] == f[1] for f in client.frames)
    refused = sum(1 for r in client.replies if r[2] != 1)
    print(f"{case.__name__:16} first {client.frames[0][3]:.1f} s; frames {len(numbers)} of {advanced}, hole {hole}; latency "
          f"{middle_and_worst([f[2] for f in client.frames])} ms; pushes {len(client.replies)} answered, {refused} refused, "
          f"{client.lost} lost, {middle_and_worst([r[0] for r in client.replies])} ms; overruns {overruns}; "
          f"hashes {'equal' if same else 'DIFFER'}", flush=True)
    if client.healed:
        after = [f[3] for f in client.frames if f[3] > client.healed]
        answers = [r[1] for r in client.replies if r[1] > client.healed]
        print(f"{'':16} after the partition: a frame in {after[0] - client.healed:.1f} s, an answer in "
              f"{answers[0] - client.healed:.1f} s" if after and answers else "no recovery", flush=True)


def run(case, directory, program, hashes):
    net = bridge.Bridge()
    try:
        daemon = net.popen(0, [f"{directory}/poinsotd", "run", WORLD, "--listen", "lan", "--domain", DOMAIN],
                           stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
        daemon.stdout.readline()
        threading.Thread(target=daemon.stdout.read, daemon=True).start()
        client = Client(net, program, SECONDS if case is not partition_10_s else SECONDS + 12)
        case(net, client)
        client.end()
        net.drop = net.delay = net.jitter = 0
        overruns = status(net, directory)["overruns"]
        daemon.terminate()
        daemon.wait()
        report(case, client, overruns, hashes)
    finally:
        net.close()


def main():
    reason = bridge.why_not()
    if reason:
        print(f"skipped: {reason}")
        return
    directory, program = (os.path.abspath(path) for path in sys.argv[1:3])
    expected = subprocess.run([program, "expect", "0", os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../server/scenes",
                               WORLD + ".yaml"), str(60 * 60)], capture_output=True, text=True, check=True).stdout
    hashes = [int(line) for line in expected.split()]
    for case in CASES:
        if not sys.argv[3:] or case.__name__ in sys.argv[3:]:
            run(case, directory, program, hashes)


if __name__ == "__main__":
    main()
