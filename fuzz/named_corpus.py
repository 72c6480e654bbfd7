#!/usr/bin/env python3
"""Writes the entries of the corpus that have names: one for each past defect, in the bytes that the targets read.

What follows is the inverse of src/calls (History::new and History::step), of src/predicates and of src/loaders.rs, as
far as the entries need it. Run it again when these read bytes in another way.
"""

import os
import random
import struct

HERE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "corpus")
AUTO, REBUILDING, FLIPS, TOLERANCE, REPAIR, PLACEMENT = 0, 2, 3, 4, 5, 6
SAFE_REGION, SAFE_REGION_TOLERANCE = 7, 8
GENERAL, NEAR_SPHERE, LATTICE, TAKEN, SPHERE, EXTREME, FAR = 0, 1, 2, 203, 6, 7, 9
MERGE, REJECT, TRACK, ASK = 0x10, 0, 0x80, 1
JITTER, SHIFT, FLATTEN, SWAP, DOUBLE = 0, 4, 6, 7, 10
INSERT, REMOVE, RELOCATE, MOTION, STAGE_INSERTIONS, STAGE_REMOVALS = 0, 1, 2, 5, 9, 10
DISCARD, COMMIT, COMMIT_POSITIONS, COMPACT, TAKE, COPY, READ = 11, 12, 17, 20, 21, 22, 23
FAMILIES = ["general", "integers", "last-bits", "extremes", "distant", "sphere", "flat", "layers", "scaled-axes",
            "near-ties", "noise", "clusters", "rounded-sphere"]


class Calls:
    """A history. Places are drawn at random, by a rule."""

    def __init__(self, d, n, rule=GENERAL, scale=4, flags=MERGE, algorithm=AUTO, threads=1, seed=1):
        # Numbers of more than 256 vertices take two bytes.
        self.d, self.random, self.rule, self.is_large = d, random.Random(seed), rule, n > 256
        size = [255, n - 300] if n >= 300 else [56 + n - 3]
        self.bytes = [d - 2, *size, rule, scale, flags | threads << 2, algorithm]
        for v in range(n):
            self.place()
        self.bytes.append(200)

    def any(self, n=1):
        self.bytes += [self.random.randrange(256) for _ in range(n)]
        return self

    def place(self):
        length = {GENERAL: 6, NEAR_SPHERE: 2 * self.d, LATTICE: 2, SPHERE: 1, EXTREME: 9, FAR: 3}[self.rule]
        self.bytes.append(0)
        return self.any(length)

    def taken(self, v):
        """The place of a vertex."""
        self.bytes += [TAKEN, v] + [0] * self.is_large
        return self

    def call(self, what, *arguments, fault=None, goes_on=False, cancel=None):
        if fault is not None:
            self.bytes += [0xC0 | 0x20 * goes_on | what, fault + 128]
        elif cancel is not None:
            self.bytes += [0x80 | what, cancel]
        else:
            self.bytes.append(what)
        self.bytes += arguments
        return self

    def motion(self, rule, size=2, share=0, commits=True, **befalls):
        return self.call(MOTION, size, rule, self.random.randrange(256), share, 0, 1, int(commits), **befalls)

    def insert(self, **befalls):
        return self.call(INSERT, **befalls).place()

    def take(self):
        return self.call(TAKE)


def entries():
    for d in (2, 3):
        e = Calls(d, 20)
        for v in (3, 3, 5):
            e.call(INSERT).taken(v)
        for k in (0, 1, 2, 4, 8):
            e.call(REMOVE, 3, fault=k).call(REMOVE, 3, fault=k, goes_on=True)
        yield f"calls/memory-refused-to-removal-with-hidden-vertices-{d}d", e

        e = Calls(d, 330, threads=3)
        for v in (3, 3, 5):
            e.call(INSERT).taken(v)
        for k in (0, 2, 5, 9, 14):
            e.insert(fault=k, goes_on=True)
        yield f"calls/memory-refused-to-insertion-on-threads-with-hidden-vertices-{d}d", e

        e = Calls(d, 330)
        for k in range(8):
            e.call(STAGE_INSERTIONS, 5)
            for v in range(5):
                e.place()
            e.call(COMMIT, fault=k, goes_on=True)
        yield f"calls/memory-refused-to-undoing-of-insertions-{d}d", e

        for name, algorithm in [("auto", AUTO), ("rebuilding", REBUILDING), ("placement-flips", FLIPS),
                                ("tolerance", TOLERANCE), ("repair", REPAIR), ("safe-region", SAFE_REGION_TOLERANCE)]:
            e = Calls(d, 24, flags=MERGE | TRACK, algorithm=algorithm)
            e.call(INSERT).taken(3).call(INSERT).taken(4).take()
            for k in (1, 2, 3, 4, 6, 8, 11, 15, 20, 30):
                e.motion(JITTER, commits=False).call(COMMIT, fault=k, goes_on=k % 2 == 0)
            yield f"calls/memory-refused-to-commit-by-{name}-{d}d", e

        e = Calls(d, 20, flags=REJECT, algorithm=TOLERANCE)
        for k in range(4):
            e.motion(JITTER, 5).motion(SWAP, share=3).call(COMMIT).motion(SWAP, share=0).call(DISCARD)
            e.call(RELOCATE, 1, 0).taken(2).call(INSERT).taken(3)
        yield f"calls/coincidence-rejected-under-tolerance-{d}d", e

        for name, algorithm in [("tolerance", TOLERANCE), ("auto", AUTO), ("safe-region", SAFE_REGION)]:
            e = Calls(d, 12, rule=EXTREME, scale=4, algorithm=algorithm)
            e.bytes[5] = 0
            for k in range(48):
                e.motion(DOUBLE if k % 8 == 0 else JITTER, 0)
            yield f"calls/many-commits-with-a-growing-box-by-{name}-{d}d", e

        e = Calls(d, 16).take()
        for v in range(3):
            e.insert().call(COMMIT).take().call(REMOVE, v).take()
        e.motion(JITTER).call(COMPACT, 1).take().motion(JITTER).take()
        yield f"calls/changes-of-immediate-calls-before-a-commit-{d}d", e

        e = Calls(d, 20, flags=MERGE | ASK)
        for left in range(4):
            e.motion(SWAP, commits=False).call(COMMIT, cancel=left)
            e.call(COMMIT_POSITIONS, 2, JITTER, 1, 0, 0, cancel=left)
        yield f"calls/commits-cancelled-{d}d", e

        e = Calls(d, 20, rule=LATTICE)
        e.motion(FLATTEN).motion(JITTER, 6).motion(FLATTEN).insert()
        e.motion(SHIFT).motion(SWAP).call(COPY, 0, 0).call(COPY, 2, MERGE, AUTO)
        yield f"calls/lattice-flattened-and-back-{d}d", e

        e = Calls(d, 20, rule=SPHERE)
        e.motion(SHIFT).motion(SWAP).motion(JITTER, 6).motion(DOUBLE)
        yield f"calls/one-sphere-{d}d", e

        if d == 3:
            e = Calls(d, 420, rule=NEAR_SPHERE, algorithm=REPAIR, seed=6)
            e.motion(JITTER, 4).motion(JITTER, 4, share=5).motion(JITTER, 4)
            yield "calls/facets-stuck-in-cells-that-islands-replace", e

        for seed in range(6):
            e = Calls(d, 10, rule=FAR, seed=seed)
            yield f"calls/numbers-far-below-a-lattice-{d}d-{seed}", e.motion(JITTER).insert()

    for kind, name in [(0, "plane"), (3, "space")]:
        r = random.Random(kind)
        for k, size in enumerate([0, 1, 5, 12, 30, 59]):
            # A near tie: its shape, its points, and the change as a power of two of the extent.
            data = bytes([kind, 9, k % 2]) + bytes(r.randrange(256) for _ in range(40)) + bytes([size] * 60)
            yield f"predicates/near-tie-in-{name}-of-2-to-the-minus-{size + 1}", data
        for rule, family in enumerate(FAMILIES):
            yield f"predicates/{family}-in-{name}", bytes([kind, rule] + [r.randrange(256) for _ in range(120)])
    yield "calls/bad-positions-given-where-vertices-leave-tolerances", bytes.fromhex(
        "010ee30f360000000100004a76000000000100000000000069e80000710000000000890077c8000000000000"
        "0000000000000000000100003400000001ce00000100004200000075336ac9009500620000000000b1000000"
        "000000000100007000000000000a00002c00000000002600000000000000416f0b8d00c20000010000000000"
        "68000b00000000019e0001")
    yield "calls/memory-refused-to-undoing-of-flips-after-more-cells", bytes.fromhex(
        "0149020414000044200000fde600f1c2006bdd0001e40088750034a2000f0b000d0400c36e00d80e00714900"
        "fd7700b0760070eb00000100cc8b0502007200000100cc8f0502000f00000100ec94050200ca00000100ec9e")
    yield "calls/memory-refused-to-undoing-of-untangling-after-more-cells", bytes.fromhex(
        "0149020414000044200000fde600f1c2006bdd0001e40088750034a2000f0b000d0400c36e00d80e00714900"
        "fd7700b0760070eb00000100cc8b0502007200000100cc8f1102000f00000100ec94050200ca00000100ec9e")
    yield "calls/untangling-undone-after-flips-on-threads", bytes.fromhex(
        "01490204cf1102000f0000fd8b00f1c2256bdd0005e40088750034a2000f0b000d0400c36e00d80e00714900"
        "0100cc8f0b0d0400c36ed80e71e000fd77b07670eb00940bd5335f17003daad8619b9100ffc911f57cce00d4"
        "58bbbf2ce0003753c9bdfa0f00f0169dc957fa0074066676cfb000b4eb8902c4420069da1cf6ba6600d3f8b6"
        "d4b10000a9150502004a00000100cc810502001200000100ec820502005200000100cc83050200e400000100"
        "ec84050200da00000100ec860502007000000100ec88050200e600000100cc8b0502007200000100cc8f0502"
        "000f00000100ec94050200ca00000100ec9e")
    yield "calls/insertions-discarded-after-all-cells-are-built", bytes.fromhex(
        "00b9a60000000000000000000000000000000000000000000000000000000000000000000000000000000000"
        "000052010001008600007500000000010100a300000000000000000000c400000000000000000000697c0000"
        "ed0100009600000000000000000000000000003531000000000002010100000000008b0054")
    yield "predicates/number-far-below-a-lattice", bytes.fromhex("00020013000000020001004401")

    for d in (2, 3):
        for k in range(24):
            r = random.Random(100 * d + k)
            head = bytes([1 | 8 * (d - 2) | 0x10, r.choice([0, 2, 4, 6]), 4, 13])
            yield f"loaders/saved-and-damaged-{d}d-{k}", head + bytes(r.randrange(200) for _ in range(140))
        yield f"loaders/head-alone-{d}d", struct.pack("<B8x4xI", 0x10, d) + bytes(170)
    yield "loaders/neighbours-saved-as-if-on-the-hull-2d", bytes.fromhex(
        "1106040d9b0ab4950f4c8e21270b4b2fc285525e6222c6176c4963114ec60b29240877490d4731536a9382f7"
        "9a9529428f18be279e42bbb24911923a9b425f4f7276c60942c01fc6bdb806889293b51a7736210db6704cbb"
        "9b0534160c93c632b3ae8379a09e0e491f5087038e587c4c25bc9130181d9b822bc29108134f99a1b7895cad"
        "94a135bd399fb5af50439a90365833456e8a80620a47a7703ead985231aa0abc0db9546d4dc109a31f70")


for path, entry in entries():
    data = entry if isinstance(entry, bytes) else bytes(entry.bytes)
    with open(os.path.join(HERE, path), "wb") as file:
        file.write(data)
