# SPDX-License-Identifier: Apache-2.0
"""The tables of the bench. In engine/SPEED.md they stand between <!-- bench: NAME --> and
<!-- end -->; the words around them are written by people."""

import re

from study_page import number, table

FRACTIONS = (0.1, 0.3, 0.5, 0.7)
MAIN = 0.3
ENGINES = ("stoss", "Box2D", "Box2D-bullet", "Chipmunk")

# ns a collision at FRACTIONS.
AIMS = {10_000: (750, 520, 480, 320), 100_000: (1800, 1150, 1050, 720)}


def find(results, scene, engine="stoss", disks=None, **others):
    """The first row of that kind, or None."""
    for row in results["worlds"]:
        if row["scene"] == scene and row["engine"] == engine and disks in (None, row["disks"]) and \
                all(row.get(key) == value for key, value in others.items()):
            return row
    return None


def plain(value):
    """Three digits, and no power of ten for what is large."""
    return f"{value:,.0f}" if value is not None and abs(value) >= 100 else number(value, 3)


def figure(row, key, factor=1):
    return plain(factor * row[key]) if row and key in row else "–"


def whole(row, key, factor=1):
    return f"{factor * row[key]:.0f}" if row and key in row else "–"


def circumstances(results):
    changed = " with changes" if results["engine_changed_since"] else ""
    pages = "pages of 2 MB" if results["large_pages"] else "no pages of 2 MB"
    return (f"{results['processor']}, {results['cores']} cores, {pages}; {results['compiler']}, "
            f"`{results['flags']}`; commit {results['commit']}{changed}, {results['date']}; "
            f"{results['rounds']} rounds; load {results['load_before']:.1f} before, "
            f"{results['load_after']:.1f} after.")


def collisions(results):
    """ns a collision, disks with disks, by area fraction and number of disks."""
    counts = sorted({row["disks"] for row in results["worlds"] if row["scene"] == "gas"})

    def cell(engine, disks):
        rows = [find(results, "gas", engine, disks, area_fraction=f) for f in FRACTIONS]
        return " / ".join(whole(row, "ns_per_collision") for row in rows) if any(rows) else ""
    lines = [[engine, *(cell(engine, n) for n in counts)] for engine in ENGINES]
    lines.insert(1, ["the aim", *(" / ".join(map(str, AIMS[n])) if n in AIMS else ""
                                  for n in counts)])
    lines = [line for line in lines if any(line[1:])]
    return table(["ns at 0.1 / 0.3 / 0.5 / 0.7", *(f"N = {n:,}" for n in counts)], lines)


def wrongs(results):
    """What a mean free time costs in every engine, and what it got wrong."""
    lines = []
    for row in results["worlds"]:
        if "missed" not in row or not (row["engine"] != "stoss" or row["area_fraction"] == MAIN):
            continue
        exact = find(results, row["scene"], "stoss", row["disks"],
                     area_fraction=row["area_fraction"])
        ratio = row["ms_per_free_time"] / exact["ms_per_free_time"] if exact else None
        lines.append([row["scene"], f"{row['disks']:,}", f"{row['area_fraction']:g}",
                      row["engine"], figure(row, "ms_per_free_time"), plain(ratio),
                      f"{100 * row['missed']:.1f} %", number(row["energy_error"]),
                      number(row["overlap"])])
    return table(["world", "disks", "area fraction", "engine", "ms a mean free time",
                  "ratio to stoss", "missed", "energy error", "deepest overlap"], lines)


def others(results):
    """The worlds that are no benchmark's."""
    lines = []
    for scene in ("gas", "mixture-10", "mixture-100", "maze", "burst"):
        row = find(results, scene, area_fraction=MAIN,
                   disks=100_000 if scene in ("gas", "maze") else None)
        if row:
            lines.append([scene, f"{row['disks']:,}", whole(row, "ns_per_collision"),
                          whole(row, "ns_per_contact"), whole(row, "bytes_per_body")])
    return table(["world", "disks", "ns a collision", "ns a contact, walls too", "bytes a body"],
                 lines)


def resting(results):
    lines = [[engine, figure(row, "us_per_tick"), figure(row, "contacts_per_tick"),
              f"{100 * row['share_of_core']:.3g} %"]
             for engine in ENGINES if (row := find(results, "bullet", engine))]
    return table(["resting disks and a bullet", "µs a tick", "contacts a tick", "of a core"], lines)


def commands(results):
    lines = [[f"{row['kind']}, {row['disks']:,} disks", whole(row, "ns")]
             for row in results["worlds"] if row["scene"] == "command"]
    return table(["command, with changes and hash after it", "ns"], lines)


def loading(results):
    row = find(results, "load")
    if not row:
        return ""
    return table(["loading from .binpb", "s"],
                 [[f"{row['disks']:,} disks", figure(row, "ns", factor=1e-9)],
                  ["of this: read and check", figure(row, "read_s")],
                  ["translate", figure(row, "translate_s")],
                  ["overlaps, neighbours, first events", figure(row, "make_s")]])


def daemon(results):
    """Raw DDS and the daemon, a column for each number of bodies."""
    found = results["daemon"].get("frames", [])
    if not found:
        return ""
    rows = [("raw DDS: ns a body's state", "raw_ns", 1),
            ("stossd: ns a body's state", "stossd_ns", 1), ("ratio", "ratio", 1),
            ("frames a second", "frames_per_second", 1),
            ("frames left out", "frames_late", 1), ("real-time factor", "real_time_factor", 1),
            ("ticks late", "ticks_late", 1), ("ticks put off", "ticks_slipped", 1),
            ("world's thread: % of a core", "world_share", 100),
            ("its ns an event while frames are read", "world_ns_publishing", 1),
            ("its ns an event without readers", "world_ns_alone", 1),
            ("other threads: % of a core", "others_share", 100),
            ("their ns an event, to follow the world", "following_ns", 1)]
    lines = [[what, *(figure(frames, key, factor) for frames in found)]
             for what, key, factor in rows]
    command = results["daemon"].get("command")
    if command:
        lines.append(["a command and its reply: raw DDS, stossd, ratio",
                      f"{plain(command['raw_ns'])} / {plain(command['stossd_ns'])} / "
                      f"{plain(command['ratio'])}", *("" for _ in found[1:])])
    heads = ["frames at 60 Hz, one reader", *(f"{row['bodies']:,} bodies" for row in found)]
    return (table(heads, lines) + f"\n\nLoad {results['daemon']['load_before']:.1f} before, "
            f"{results['daemon']['load_after']:.1f} after.")


def kernels(results):
    lines = [[name, plain(ns)] for name, ns in results["kernel_bench"].items()]
    lines += [[f"{name} events", plain(ns)] for name, ns in results["queue_bench"].items()]
    return table(["kernel or queue", "ns"], lines)


# The aims ----------------------------------------------------------------------------------------


def ratio(results, scene, engine, disks, key, other):
    """Of a figure in two rows, or None."""
    row = find(results, scene, engine, disks, area_fraction=MAIN)
    return row[key] / other[key] if row and other else None


def verdicts(results):
    """(what, figure or None, limit, whether the figure must be above it)"""
    def gas(n):
        return find(results, "gas", disks=n, area_fraction=MAIN)
    for n, aims in AIMS.items():
        for fraction, aim in zip(FRACTIONS, aims):
            row = find(results, "gas", disks=n, area_fraction=fraction)
            yield (f"{n:,} disks at {fraction}: ns a collision",
                   row and row["ns_per_collision"], aim, False)
    yield ("a million disks: cost beside 1,000",
           ratio(results, "gas", "stoss", 1_000_000, "ns_per_collision", gas(1_000)), 3, False)
    for n in (1_000, 10_000):
        for engine, least in (("Box2D-bullet", 40), ("Chipmunk", 20)):
            yield (f"{engine}, {n:,} disks: CPU a mean free time beside ours",
                   ratio(results, "gas", engine, n, "ms_per_free_time", gas(n)), least, True)
    ten = find(results, "mixture-10")
    yield "size ratio 10: ns a collision", ten and ten["ns_per_collision"], 1200, False
    yield ("size ratio 100: cost beside equal disks",
           ratio(results, "mixture-100", "stoss", None, "ns_per_contact", gas(10_000)), 2, False)
    yield ("10,000 walls: cost of a contact beside none",
           ratio(results, "maze", "stoss", None, "ns_per_contact", gas(100_000)), 1.5, False)
    rest = find(results, "bullet")
    yield "resting disks: share of a core", rest and rest["share_of_core"], 0.01, False
    load = find(results, "load")
    yield (f"loading {load['disks']:,} disks: s" if load else "loading: s",
           load and 1e-9 * load["ns"], 2 if load and load["disks"] == 1_000_000 else 0.2, False)
    for frames in results["daemon"].get("frames", []):
        yield (f"publishing {frames['bodies']:,} bodies: CPU beside raw DDS", frames["ratio"], 1.5,
               False)
        yield (f"daemon at {frames['bodies']:,} bodies and 60 Hz: real-time factor",
               frames["real_time_factor"], 0.999, True)
    body = gas(100_000)
    yield "bytes a body", body and body["bytes_per_body"], 256, False


def verdict_table(results):
    lines = []
    for what, value, limit, above in verdicts(results):
        if value is None:
            continue
        met = value >= limit if above else value <= limit
        lines.append([what, plain(value), f"{'≥' if above else '≤'} {limit:g}",
                      "met" if met else "not met"])
    return table(["aim", "measured", "limit", ""], lines)


BLOCKS = {"circumstances": circumstances, "collisions": collisions, "wrongs": wrongs,
          "others": others, "resting": resting, "commands": commands, "loading": loading,
          "daemon": daemon, "kernels": kernels, "aims": verdict_table}


def page(results):
    return "\n\n".join(block(results) for block in BLOCKS.values())


def with_tables(text, results):
    """The page with every block made anew. Raises KeyError for a block that is not known."""
    def block(match):
        return f"<!-- bench: {match.group(1)} -->\n{BLOCKS[match.group(1)](results)}\n<!-- end -->"
    return re.sub(r"<!-- bench: (\w+) -->\n.*?<!-- end -->", block, text, flags=re.DOTALL)
