#!/usr/bin/env python3
"""Sends malformed RTPS packets to a daemon and says which kinds the packaged library survives.

    rtps_storm.py DIRECTORY [--domain N] [--packets N] [--seed N] [KIND...]

DIRECTORY holds poinsotd and poinsot. Each kind meets a fresh daemon on 127.0.0.1, from a peer that the
daemon has discovered and whose writer its reader of commands has matched, so that packets get as far as
they can. A line for each kind: its name, packets, what became of the daemon (fine; deaf: alive, and does
not answer a client; dead: how it ended), its memory before and after, whether frames went on in time
(overruns), and what of the next start. The daemon may have 4 GB; who asks for more is dead by bad_alloc.
"""

import argparse
import json
import os
import random
import resource
import signal
import struct
import subprocess
import sys
import time

import rtps
from rtps import (CDR, DATA, DATA_FRAG, LIVELINESS_READER, LIVELINESS_WRITER, PARTICIPANT, PL_CDR, PUBLICATIONS_READER,
                  PUBLICATIONS_WRITER, SENTINEL, SPDP_READER, SPDP_WRITER, SUBSCRIPTIONS_READER,
                  SUBSCRIPTIONS_WRITER, UNKNOWN, USER_WRITER, acknack, data, fragment, gap, header, heartbeat,
                  number_set, parameter, sequence_number, submessage, text)

WORLD = "bouncing_balls"
TOPIC = f"poinsot/{WORLD}/wrench"
TYPE = "poinsot::msg::v2::BodyWrench"
MEMORY = 4 << 30
HUGE = (0, 1, 2, 3, 255, 256, 257, 0x7FFF, 0xFFFF, 0x10000, 0x7FFFFFFF, 0x80000000, 0xFFFFFFFE, 0xFFFFFFFF)
FAR = (-(1 << 62), -2, -1, 0, 1, 2, 1000, (1 << 31) - 1, 1 << 32, (1 << 62), (1 << 63) - 1)
DAEMON_WRITERS_AND_READERS = ((PUBLICATIONS_WRITER, PUBLICATIONS_READER), (SUBSCRIPTIONS_WRITER, SUBSCRIPTIONS_READER),
                              (SPDP_WRITER, SPDP_READER), (LIVELINESS_WRITER, LIVELINESS_READER), (USER_WRITER, UNKNOWN))


def noise(r, most):
    return r.randbytes(r.randrange(most + 1))


def good(peer, r, n):
    """A well-formed packet, of many kinds."""
    writer, reader = r.choice(DAEMON_WRITERS_AND_READERS)
    return peer.packet(*r.sample([
        peer.announcement(), peer.publication(), heartbeat(writer, reader, 1, n + 1, n),
        gap(writer, reader, n + 1, n + 2), acknack(reader, writer, 1, 32, [0xFFFFFFFF], n),
        data(writer, reader, n + 1, CDR + noise(r, 200)), fragment(writer, reader, n + 1, 1, 1, 1000, 3000, bytes(1000)),
        submessage(rtps.INFO_TS, bytes(8)), submessage(rtps.INFO_DST, peer.target),
        submessage(rtps.HEARTBEAT_FRAG, reader + writer + sequence_number(n + 1) + struct.pack("<II", 3, n)),
        submessage(rtps.NACK_FRAG, reader + writer + sequence_number(n + 1) + struct.pack("<III", 1, 32, 0xFFFFFFFF) +
                   struct.pack("<I", n))], 3))


# Kinds: each makes packet number n.

def random_bytes(peer, r, n):
    return noise(r, 1400)


def random_behind_header(peer, r, n):
    return header(peer.prefix) + noise(r, 1400)


def every_submessage(peer, r, n):
    return peer.packet(submessage(n % 256, noise(r, 64), r.randrange(256)))


def wrong_length(peer, r, n):
    packet = bytearray(good(peer, r, n))
    struct.pack_into("<H", packet, 22, r.choice(HUGE) & 0xFFFF)
    return bytes(packet)


def truncated(peer, r, n):
    packet = good(peer, r, n)
    return packet[:n % len(packet)]


def bit_flips(peer, r, n):
    packet = bytearray(good(peer, r, n))
    for _ in range(r.randint(1, 8)):
        packet[r.randrange(20, len(packet))] ^= 1 << r.randrange(8)
    return bytes(packet)


def many_submessages(peer, r, n):
    return peer.packet(*[submessage(r.choice((rtps.PAD, rtps.INFO_TS, rtps.INFO_DST, 0x80)), b"", r.randrange(2))] * 16000)


def info(peer, r, n):
    return peer.packet(
        submessage(rtps.INFO_DST, noise(r, 20)), submessage(rtps.INFO_SRC, noise(r, 30)),
        submessage(rtps.INFO_REPLY, struct.pack("<I", r.choice(HUGE)) + noise(r, 60), r.randrange(4)),
        submessage(rtps.INFO_REPLY_IP4, noise(r, 20), r.randrange(4)), heartbeat(USER_WRITER, UNKNOWN, 1, 1, n))


def heartbeat_counts(peer, r, n):
    writer, reader = r.choice(DAEMON_WRITERS_AND_READERS)
    first = r.choice((1, 0, -1, 5, 1000))
    return peer.packet(heartbeat(writer, reader, first, first + r.randrange(-2, 300), r.choice(HUGE), r.randrange(1, 8)))


def heartbeat_ranges(peer, r, n):
    return peer.packet(heartbeat(USER_WRITER, UNKNOWN, r.choice(FAR), r.choice(FAR), n, r.randrange(1, 8)))


def acknack_sets(peer, r, n):
    writer, reader = r.choice(DAEMON_WRITERS_AND_READERS)
    words = [r.getrandbits(32) for _ in range(r.randrange(10))]
    return peer.packet(submessage(rtps.INFO_DST, peer.target),
                       acknack(reader, writer, r.choice(FAR), r.choice(HUGE), words, r.choice((n, 0xFFFFFFFF))))


def nack_frag_sets(peer, r, n):
    writer, reader = r.choice(DAEMON_WRITERS_AND_READERS)
    words = b"".join(struct.pack("<I", r.getrandbits(32)) for _ in range(r.randrange(10)))
    return peer.packet(submessage(rtps.NACK_FRAG, reader + writer + sequence_number(r.choice(FAR)) + struct.pack(
        "<II", r.choice(HUGE), r.choice(HUGE)) + words + struct.pack("<I", n)))


def gap_sets(peer, r, n):
    """Ranges that are short or upside down, sets that are not what they claim to be."""
    start = r.choice((-1, 0, 1, 2, 1000))
    words = [r.getrandbits(32) for _ in range(r.randrange(10))]
    return peer.packet(gap(USER_WRITER, UNKNOWN, start, start + r.randrange(-300, 300), r.choice(HUGE), words))


def gap_of_a_million(peer, r, n):
    return peer.packet(gap(USER_WRITER, UNKNOWN, 1 + n * 1000000, 1000000 + n * 1000000))


def gap_without_end(peer, r, n):
    return peer.packet(gap(USER_WRITER, UNKNOWN, 1, (1 << 62) + n))


def data_sizes(peer, r, n):
    writer, reader = r.choice(DAEMON_WRITERS_AND_READERS)
    payload = r.choice((b"", b"\0", b"\0\1", b"\0\1\0", CDR, CDR + b"\0", noise(r, 1200)))
    return peer.packet(data(writer, reader, n + 1, payload, r.randrange(16) | 1, noise(r, 40), r.choice(HUGE) & 0xFFFF))


def inline_qos(peer, r, n):
    qos = b"".join(parameter(r.choice((0x02, 0x70, 0x71, 0x61, 0x800F, 0x83, r.getrandbits(16))), noise(r, 24),
                             r.choice((None, 0, 3, 8, 16, 0xFFFC, 0xFFFF))) for _ in range(r.randrange(6)))
    return peer.packet(data(USER_WRITER, UNKNOWN, n + 1, CDR + noise(r, 300), 7, qos + r.choice((b"", SENTINEL))))


def fragments(peer, r, n):
    size = r.choice(HUGE + (1000, 1300)) & 0xFFFF
    return peer.packet(fragment(USER_WRITER, UNKNOWN, 1 + n // 4, r.choice(HUGE), r.choice(HUGE) & 0xFFFF, size,
                                r.choice(HUGE + (3000, 5000000)), noise(r, 1300), r.randrange(16) | 1))


def fragments_of_a_giant(peer, r, n):
    """The first fragment of a sample of nearly 4 GB, again and again."""
    return peer.packet(fragment(USER_WRITER, UNKNOWN, n + 1, 1, 1, 1000, 0xFFFFFF00, bytes(1000)))


def fragments_of_the_largest(peer, r, n):
    """The same of as much as a sample may have: 200 MB."""
    return peer.packet(fragment(USER_WRITER, UNKNOWN, n + 1, 1, 1, 1000, 200000000, bytes(1000)))


def heartbeat_frags(peer, r, n):
    return peer.packet(submessage(rtps.HEARTBEAT_FRAG, UNKNOWN + USER_WRITER + sequence_number(r.choice(FAR)) +
                                  struct.pack("<II", r.choice(HUGE), n)),
                       fragment(USER_WRITER, UNKNOWN, n + 1, 2, 1, 1000, 3000, bytes(1000)))


def parameter_lists(peer, r, n):
    """Announcements with parameters of any kind, wrong lengths, and no end."""
    wild = b"".join(parameter(r.choice((r.randrange(0x90), 0x8000 + r.randrange(0x20), r.getrandbits(16))),
                              r.choice((noise(r, 40), struct.pack("<I", r.choice(HUGE)) + noise(r, 20))),
                              r.choice((None, None, None, 0, 1, 2, 0xFFFF))) for _ in range(r.randrange(1, 12)))
    if n % 2:
        return peer.packet(data(SPDP_WRITER, SPDP_READER, n + 2, PL_CDR + rtps.participant_list(
            peer.prefix[:-4] + r.randbytes(4), 9, 9) + wild + r.choice((b"", SENTINEL))))
    return peer.packet(peer.publication(wild, n + 2))


def huge_parameter_list(peer, r, n):
    """As many locators, partitions and properties as a datagram holds."""
    many = r.choice((parameter(0x31, rtps.locator(9)) * 2000,
                     parameter(0x29, struct.pack("<I", 5000) + text("p") * 5000),
                     parameter(0x59, struct.pack("<I", 2500) + (text("ab") + bytes(1)) * 5000),
                     parameter(0x2C, struct.pack("<I", 60000) + bytes(60000))))
    return peer.packet(data(SPDP_WRITER, SPDP_READER, n + 2, PL_CDR + rtps.participant_list(
        peer.prefix[:-2] + r.randbytes(2), 9, 9) + many[:60000] + SENTINEL))


def type_objects(peer, r, n):
    """Writers that announce types: identifiers, objects and information of random content."""
    extra = b"".join(parameter(pid, noise(r, 200)) for pid in (0x69, 0x72, 0x75))
    return peer.packet(peer.publication(extra, n + 2, struct.pack(">I", 0x00010003 + (n << 8))))


def participants(peer, r, n):
    """A new participant with each packet."""
    prefix = b"\x01\x0f" + r.randbytes(10)
    return header(prefix) + data(SPDP_WRITER, SPDP_READER, 1, PL_CDR + rtps.participant_list(prefix, 9, 9) + SENTINEL)


def endpoints(peer, r, n):
    """A new writer of the topic of commands with each packet."""
    return peer.packet(peer.publication(b"", n + 2, struct.pack(">I", 0x00010003 + (n << 8))))


def liveliness(peer, r, n):
    payload = r.choice((CDR, PL_CDR)) + r.choice((peer.prefix, b"", noise(r, 12))) + noise(r, 8) + struct.pack(
        "<I", r.choice(HUGE)) + noise(r, 40)
    return peer.packet(data(LIVELINESS_WRITER, LIVELINESS_READER, n + 1, payload))


def departures(peer, r, n):
    """Participants and endpoints that leave: some that were never there, with and without key."""
    key = r.choice((peer.prefix + PARTICIPANT, peer.prefix + USER_WRITER, r.randbytes(16), noise(r, 20)))
    qos = parameter(0x70, key) + parameter(0x71, struct.pack(">I", r.randrange(8))) + SENTINEL
    writer, reader = r.choice(DAEMON_WRITERS_AND_READERS)
    return peer.packet(data(writer, reader, n + 2, r.choice((b"", PL_CDR + parameter(0x50, key) + SENTINEL)),
                            r.choice((3, 7, 11)), qos))


def in_the_daemons_name(peer, r, n):
    return header(peer.target) + good(peer, r, n)[20:]


KINDS = [random_bytes, random_behind_header, every_submessage, wrong_length, truncated, bit_flips, many_submessages, info,
         heartbeat_counts, heartbeat_ranges, acknack_sets, nack_frag_sets, gap_sets, gap_of_a_million, gap_without_end,
         data_sizes, inline_qos, fragments, fragments_of_a_giant, fragments_of_the_largest,
         heartbeat_frags, parameter_lists, huge_parameter_list,
         type_objects, participants, endpoints, liveliness, departures, in_the_daemons_name]


class Daemon:
    def __init__(self, directory, domain):
        self.directory, self.domain = directory, str(domain)
        self.process = subprocess.Popen(
            [f"{directory}/poinsotd", "run", WORLD, "--domain", self.domain, "--take-over"], stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL, preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY)))
        self.process.stdout.readline()

    def memory(self):
        """[MB] resident"""
        with open(f"/proc/{self.process.pid}/statm") as f:
            return int(f.read().split()[1]) * os.sysconf("SC_PAGE_SIZE") / 1e6

    def status(self):
        """What a client hears within five seconds; nothing if it does not."""
        answer = subprocess.run([f"{self.directory}/poinsot", "status", "--json", "--timeout", "5s", "--world", WORLD, "--domain",
                                 self.domain], capture_output=True, timeout=30)
        return json.loads(answer.stdout) if answer.returncode == 0 else None

    def control(self):
        """Whether a client's command is taken and answered."""
        return subprocess.run([f"{self.directory}/poinsot", "resume", "--timeout", "5s", "--world", WORLD, "--domain", self.domain],
                              capture_output=True, timeout=30).returncode == 0

    def end(self):
        if self.process.poll() is None:
            self.process.send_signal(signal.SIGTERM)
            try:
                self.process.wait(5)
            except subprocess.TimeoutExpired:
                self.process.kill()
        self.process.stdout.close()
        return self.process.wait()


def became(daemon):
    """(word, status) after a storm."""
    code = daemon.process.poll()
    if code is not None:
        return "dead: " + (signal.Signals(-code).name if code < 0 else f"exit {code}"), None
    status = daemon.status()
    if status is None:
        return "deaf", None
    if not daemon.control():
        return "deaf to commands", status
    return "fine", status


def storm(directory, domain, kind, packets, r):
    daemon = Daemon(directory, domain)
    peer = rtps.Peer(domain, TOPIC, TYPE)
    met = peer.meet()
    before, sent = daemon.memory(), 0
    for n in range(packets):
        packet = kind(peer, r, n)[:65000]
        for send in (peer.to_meta, peer.to_user):
            try:
                send(packet)
            except OSError:
                pass  # nobody listens any more
        sent += 1
        if n % 20 == 19:
            time.sleep(0.002)  # no more than its socket holds
            peer.listen(0)
            if daemon.process.poll() is not None:
                break
    time.sleep(0.5)
    word, status = became(daemon)
    after = daemon.memory() if daemon.process.poll() is None else 0
    daemon.end()
    peer.close()
    again = Daemon(directory, domain)
    started = again.status() is not None
    again.end()
    print(f"{kind.__name__:22} {sent:6} {word:18} {before:5.0f} {after:5.0f} MB  overruns "
          f"{status['overruns'] if status else '-':>3}  {'' if met else 'not met '}{'' if started else 'NO RESTART'}", flush=True)
    return word


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("directory")
    parser.add_argument("kinds", nargs="*")
    parser.add_argument("--domain", type=int, default=60)
    parser.add_argument("--packets", type=int, default=2000)
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    kinds = [k for k in KINDS if not options.kinds or k.__name__ in options.kinds]
    print("kind                   packets daemon          memory before, after")
    words = [storm(options.directory, options.domain, k, options.packets, random.Random(options.seed)) for k in kinds]
    print(f"{words.count('fine')} of {len(words)} kinds survived")


if __name__ == "__main__":
    sys.exit(main())
