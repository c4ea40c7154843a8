"""A bad network between two network namespaces, without support of the kernel: each has a tap device,
and a thread carries every frame from one to the other, unless it drops, delays or overtakes it. Needs
root and /dev/net/tun. Namespaces and devices are gone at the end."""

import fcntl
import heapq
import os
import random
import select
import shutil
import struct
import subprocess
import tempfile
import threading
import time

TUNSETIFF, IFF_TAP, IFF_NO_PI = 0x400454CA, 0x0002, 0x1000


def why_not():
    """Why it cannot run here; nothing if it can."""
    if os.geteuid() != 0:
        return "not root"
    if not os.path.exists("/dev/net/tun"):
        return "no /dev/net/tun"
    name = f"poinsot{os.getpid()}t"
    try:
        if subprocess.run(["ip", "netns", "add", name], capture_output=True).returncode != 0:
            return "network namespaces cannot be made"
        subprocess.run(["ip", "netns", "delete", name], check=True)
        os.close(open_tap(name))
    except OSError as error:
        return str(error)
    return None


def open_tap(name):
    tap = os.open("/dev/net/tun", os.O_RDWR | os.O_NONBLOCK)
    fcntl.ioctl(tap, TUNSETIFF, struct.pack("16sH", name.encode(), IFF_TAP | IFF_NO_PI))
    return tap


class Bridge:
    """Hosts 0 and 1 are 10.77.0.1 and 10.77.0.2. What it does to frames may be set at any time."""

    def __init__(self):
        self.drop = 0.0       # [-] share of frames
        self.delay = 0.0      # [s] of each frame
        self.jitter = 0.0     # [s] more, at most: frames overtake each other
        self.cut = False      # nothing passes
        self.carried = self.dropped = 0
        self.random = random.Random(1)
        self.waiting = []     # heap of (when, number, tap, frame)
        self.memory = [tempfile.mkdtemp() for _ in "ab"]
        self.names = [f"poinsot{os.getpid()}{side}" for side in "ab"]
        self.taps = [open_tap(name) for name in self.names]
        for host, name in enumerate(self.names):
            for command in (f"netns add {name}", f"link set {name} netns {name}", f"-n {name} link set lo up",
                            f"-n {name} addr add 10.77.0.{host + 1}/24 dev {name}", f"-n {name} link set {name} up"):
                subprocess.run(["ip"] + command.split(), check=True)
        self.running = True
        self.thread = threading.Thread(target=self.carry)
        self.thread.start()

    def close(self):
        self.running = False
        self.thread.join()
        for tap, name, memory in zip(self.taps, self.names, self.memory):
            os.close(tap)
            subprocess.run(["ip", "netns", "delete", name])
            shutil.rmtree(memory)

    def popen(self, host, arguments, **more):
        """A process on a host, whose processes share memory with each other and nobody else."""
        return subprocess.Popen(["ip", "netns", "exec", self.names[host], "sh", "-c",
                                 'mount --bind "$0" /dev/shm && exec "$@"', self.memory[host]] + arguments, **more)

    def carry(self):
        while self.running:
            now = time.monotonic()
            while self.waiting and self.waiting[0][0] <= now:
                _, _, tap, frame = heapq.heappop(self.waiting)
                self.write(tap, frame)
            patience = min(0.1, self.waiting[0][0] - now) if self.waiting else 0.1
            for tap in select.select(self.taps, [], [], max(0, patience))[0]:
                self.accept(self.taps[1 - self.taps.index(tap)], os.read(tap, 65536))

    def accept(self, tap, frame):
        if self.cut or self.random.random() < self.drop:
            self.dropped += 1
            return
        self.carried += 1
        late = self.delay + self.random.random() * self.jitter
        if late == 0:
            self.write(tap, frame)
        else:
            heapq.heappush(self.waiting, (time.monotonic() + late, self.carried, tap, frame))

    def write(self, tap, frame):
        try:
            os.write(tap, frame)
        except OSError:
            self.dropped += 1  # its queue is full, or it is going down
