"""RTPS 2.3 on UDP, as little of it as it takes to be met by a participant: packets, and a peer that is
announced and matched. Little-endian throughout. Domain, ports and ids as in section 9 of the standard."""

import os
import socket
import struct
import time

# Submessages
PAD, ACKNACK, HEARTBEAT, GAP, INFO_TS = 0x01, 0x06, 0x07, 0x08, 0x09
INFO_SRC, INFO_REPLY_IP4, INFO_DST, INFO_REPLY = 0x0C, 0x0D, 0x0E, 0x0F
NACK_FRAG, HEARTBEAT_FRAG, DATA, DATA_FRAG = 0x12, 0x13, 0x15, 0x16

# Entities
UNKNOWN = bytes(4)
PARTICIPANT = bytes.fromhex("000001c1")
SPDP_WRITER, SPDP_READER = bytes.fromhex("000100c2"), bytes.fromhex("000100c7")
PUBLICATIONS_WRITER, PUBLICATIONS_READER = bytes.fromhex("000003c2"), bytes.fromhex("000003c7")
SUBSCRIPTIONS_WRITER, SUBSCRIPTIONS_READER = bytes.fromhex("000004c2"), bytes.fromhex("000004c7")
LIVELINESS_WRITER, LIVELINESS_READER = bytes.fromhex("000200c2"), bytes.fromhex("000200c7")
USER_WRITER = bytes.fromhex("00000103")  # of our own

PL_CDR = bytes.fromhex("00030000")
CDR = bytes.fromhex("00010000")
SENTINEL = struct.pack("<HH", 1, 0)


def header(prefix):
    return b"RTPS\x02\x03\x01\x0f" + prefix


def submessage(kind, body, flags=1, length=None):
    return struct.pack("<BBH", kind, flags, len(body) & 0xFFFF if length is None else length) + body


def sequence_number(n):
    return struct.pack("<iI", (n >> 32) if n >= 0 else -1, n & 0xFFFFFFFF)


def number_set(base, bits, words):
    return sequence_number(base) + struct.pack("<I", bits) + b"".join(struct.pack("<I", w) for w in words)


def parameter(pid, value, length=None):
    value += bytes(-len(value) % 4)
    return struct.pack("<HH", pid, len(value) if length is None else length) + value


def text(value):
    data = value.encode() + b"\0"
    return struct.pack("<I", len(data)) + data


def locator(port, address="127.0.0.1"):
    return struct.pack("<iI", 1, port) + bytes(12) + socket.inet_aton(address)


def data(writer, reader, number, payload, flags=5, inline_qos=b"", to_inline_qos=16):
    return submessage(DATA, struct.pack("<HH", 0, to_inline_qos) + reader + writer +
                      sequence_number(number) + inline_qos + payload, flags)


def heartbeat(writer, reader, first, last, count, flags=1):
    return submessage(HEARTBEAT, reader + writer + sequence_number(first) + sequence_number(last) +
                      struct.pack("<I", count), flags)


def gap(writer, reader, start, base, bits=0, words=()):
    return submessage(GAP, reader + writer + sequence_number(start) + number_set(base, bits, words))


def acknack(reader, writer, base, bits, words, count):
    return submessage(ACKNACK, reader + writer + number_set(base, bits, words) + struct.pack("<I", count))


def fragment(writer, reader, number, first, fragments, size, total, payload, flags=1):
    return submessage(DATA_FRAG, struct.pack("<HH", 0, 28) + reader + writer + sequence_number(number) +
                      struct.pack("<IHHI", first, fragments, size, total) + payload, flags)


def participant_list(prefix, meta_port, user_port):
    """What a participant says of itself, without the end of the list."""
    return b"".join([
        parameter(0x15, b"\x02\x03"), parameter(0x16, b"\x01\x0f"), parameter(0x50, prefix + PARTICIPANT),
        parameter(0x32, locator(meta_port)), parameter(0x31, locator(user_port)),
        parameter(0x02, struct.pack("<iI", 100, 0)), parameter(0x58, struct.pack("<I", 0xC3F))])


def writer_list(prefix, entity, topic, type_name, user_port):
    """What a participant says of a reliable writer of its own, without the end of the list."""
    return b"".join([
        parameter(0x5A, prefix + entity), parameter(0x05, text(topic)), parameter(0x07, text(type_name)),
        parameter(0x1A, struct.pack("<IiI", 2, 0, 100000000)), parameter(0x1D, struct.pack("<I", 0)),
        parameter(0x2F, locator(user_port)), parameter(0x70, prefix + entity)])


class Peer:
    """A participant that the daemon of `domain` knows, with a writer that its reader of `topic` knows."""

    def __init__(self, domain, topic, type_name):
        self.prefix = b"\x01\x0f" + os.urandom(10)
        self.base = 7400 + 250 * domain
        self.topic, self.type_name = topic, type_name
        self.meta, self.user = self.socket(10), self.socket(11)
        self.target = None   # guid prefix of the daemon
        self.meta_port = self.user_port = None  # of the daemon
        self.matched = False  # its reader has asked our writer for samples

    def socket(self, offset):
        """The port of the last participant that is greeted: the others are for real ones."""
        s = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        s.bind(("127.0.0.1", self.base + offset + 2 * 31))
        s.setblocking(False)
        return s

    def close(self):
        self.meta.close()
        self.user.close()

    def packet(self, *submessages):
        return header(self.prefix) + b"".join(submessages)

    def to_meta(self, packet):
        self.meta.sendto(packet, ("127.0.0.1", self.meta_port))

    def to_user(self, packet):
        self.user.sendto(packet, ("127.0.0.1", self.user_port))

    def announcement(self, extra=b""):
        ports = [s.getsockname()[1] for s in (self.meta, self.user)]
        return data(SPDP_WRITER, SPDP_READER, 1, PL_CDR + participant_list(self.prefix, *ports) + extra + SENTINEL)

    def publication(self, extra=b"", number=1, entity=USER_WRITER):
        return data(PUBLICATIONS_WRITER, PUBLICATIONS_READER, number, PL_CDR + writer_list(
            self.prefix, entity, self.topic, self.type_name, self.user.getsockname()[1]) + extra + SENTINEL)

    def listen(self, seconds):
        until = time.monotonic() + seconds
        while time.monotonic() < until:
            for s in (self.meta, self.user):
                try:
                    while True:
                        self.hear(s.recv(65536), s is self.user)
                except BlockingIOError:
                    pass
            time.sleep(0.005)

    def hear(self, packet, user):
        if packet[:4] != b"RTPS" or len(packet) < 24:
            return
        if user and packet.find(USER_WRITER) > 0:
            self.matched = True
        if self.target is None and packet.find(SPDP_WRITER) > 0:
            self.target = packet[8:20]
            for pid in (0x31, 0x32):  # default and metatraffic unicast locators
                at = packet.find(struct.pack("<HHi", pid, 24, 1))
                port = struct.unpack_from("<I", packet, at + 8)[0]
                if pid == 0x31:
                    self.user_port = port
                else:
                    self.meta_port = port

    def meet(self, patience=10):
        """Waits for the daemon's greeting, announces itself and its writer until the writer is asked."""
        until = time.monotonic() + patience
        while self.target is None and time.monotonic() < until:
            self.listen(0.05)
        while self.target is not None and not self.matched and time.monotonic() < until:
            self.to_meta(self.packet(self.announcement()))
            self.listen(0.1)
            self.to_meta(self.packet(self.publication(), heartbeat(
                PUBLICATIONS_WRITER, PUBLICATIONS_READER, 1, 1, int(time.monotonic() * 1000) & 0x7FFFFFFF)))
            self.to_user(self.packet(heartbeat(USER_WRITER, UNKNOWN, 1, 0, int(time.monotonic() * 1000) & 0x7FFFFFFF)))
            self.listen(0.1)
        return self.matched
