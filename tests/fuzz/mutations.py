# SPDX-License-Identifier: BSD-3-Clause
"""Damages a file's content: bytes for any file, words and lines for text.

Every function takes its random generator, so the same seed gives the same damage.
"""

import struct

# Where sizes, counts and signs go wrong.
WHOLE_NUMBERS = [0, 1, -1, 2, 7, 8, 127, 128, 255, 256, 32767, 32768, 65535, 65536, 2**31 - 1,
                 2**31, 2**32 - 1, 2**32, 2**53, 2**53 + 1, 2**63 - 1, -(2**31), -(2**63)]
REAL_NUMBERS = [0.0, -0.0, 1e-3, 0.5, -1.0, 1e-9, 1e-308, 5e-324, 1e9, 1e18, 1e38, 1e39, 1e308,
                -1e308, float("inf"), float("-inf"), float("nan")]
WORDS = ["", "0", "-0", "-1", "1e308", "-1e308", "1e-308", "1e999", "nan", "inf", "-inf", "+nan",
         "0x7fffffff", "2147483648", "4294967296", "9223372036854775807", "-9223372036854775808",
         "9223372036854775808", "18446744073709551616", "1e-5", "0.0001", "true", "false", "null",
         "\"\"", "\"\\u0000\"", "'", "\"", "[]", "{}", "[[]]", "#", "--", "%", "%s", "..", "/", "../..",
         "/dev/zero", "/dev/null", ".", "\x1b[2J", "\xff\xfe", "\u202e", "e", "=", "\t", "\0",
         "1" * 400, "a" * 70000, "[" * 5000, "{" * 5000, "(" * 5000, "-" * 5000, "1979-05-27"]


def _span(rng, content, longest=64):
    """A place in the content and a length, which may be 0."""
    begin = rng.randrange(len(content) + 1)
    return begin, min(len(content), begin + rng.choice([1, 2, 4, 8, rng.randrange(1, longest + 1)]))


def _number(rng):
    """A number that is often an edge, as it lies in a file."""
    if rng.random() < 0.3:
        value = rng.choice(REAL_NUMBERS)
        if rng.random() < 0.5:
            return struct.pack(rng.choice("<>") + "d", value)
        return struct.pack(rng.choice("<>") + "f", max(-3e38, min(3e38, value)))
    size = rng.choice([1, 2, 4, 8])
    whole = rng.choice(WHOLE_NUMBERS) % 256**size
    return whole.to_bytes(size, rng.choice(["little", "big"]))


def mutate_bytes(rng, content, other=b""):
    """Damages one place; `other` is another good file of the kind, from which pieces are taken."""
    content = bytearray(content or b"\0")
    begin, end = _span(rng, content)
    way = rng.randrange(9)
    if way == 0:
        at = min(begin, len(content) - 1)
        content[at] ^= 1 << rng.randrange(8)
    elif way == 1:
        content[begin:end] = rng.randbytes(end - begin)
    elif way in (2, 3):
        number = _number(rng)
        content[begin:begin + len(number)] = number
    elif way == 4:
        del content[begin:end]
    elif way == 5:
        content[begin:begin] = content[begin:end] * rng.choice([1, 2, 100])
    elif way == 6:
        content[begin:begin] = rng.randbytes(end - begin)
    elif way == 7:
        del content[begin:]
    else:
        source = other or content
        there, there_end = _span(rng, source, 4096)
        content[begin:end] = source[there:there_end]
    return bytes(content)


def _is_part_of_word(byte):
    return bytes([byte]).isalnum() or byte in b"._-+"


def _words(content):
    """Where words and numbers stand."""
    places, begin = [], None
    for at, byte in enumerate(content + b" "):
        if _is_part_of_word(byte):
            begin = at if begin is None else begin
        elif begin is not None:
            places.append((begin, at))
            begin = None
    return places


def mutate_words(rng, content, other=b""):
    """Replaces a word by a hostile one, or by another of this file or of `other`."""
    places = _words(content)
    if not places:
        return mutate_bytes(rng, content, other)
    begin, end = rng.choice(places)
    if rng.random() < 0.7:
        word = rng.choice(WORDS).encode("latin-1", "replace")
        if rng.random() < 0.1:
            word = repr(rng.choice(REAL_NUMBERS + WHOLE_NUMBERS)).encode()
    else:
        source = other if other and rng.random() < 0.5 else content
        there = _words(source)
        from_, to = rng.choice(there) if there else (0, 0)
        word = source[from_:to]
    return content[:begin] + word + content[end:]


def mutate_digits(rng, content, other=b""):
    """Makes a number somewhat other than it was, so that much of it stays legal."""
    places = [(begin, end) for begin, end in _words(content)
              if content[begin:begin + 1].isdigit()]
    if not places:
        return mutate_words(rng, content, other)
    begin, end = rng.choice(places)
    try:
        value = float(content[begin:end]) * rng.choice([-1.0, 0.0, 1e-6, 1e-3, 0.1, 0.5, 2.0, 10.0,
                                                        1e3, 1e6, 1e12])
    except ValueError:
        return mutate_words(rng, content, other)
    is_whole = content[begin:end].isdigit() and abs(value) < 1e15
    return content[:begin] + repr(int(value) if is_whole else value).encode() + content[end:]


def mutate_lines(rng, content, other=b""):
    """Drops, doubles, moves or takes over a line."""
    lines = content.split(b"\n")
    at = rng.randrange(len(lines))
    way = rng.randrange(4)
    if way == 0:
        del lines[at]
    elif way == 1:
        lines[at:at] = [lines[at]] * rng.choice([1, 2, 1000])
    elif way == 2:
        there = rng.randrange(len(lines))
        lines[at], lines[there] = lines[there], lines[at]
    else:
        lines.insert(at, rng.choice((other or content).split(b"\n")))
    return b"\n".join(lines)


def damaged(rng, content, other=b"", is_text=False):
    """One to four mutations, one after the other."""
    for _ in range(rng.choice([1, 1, 1, 2, 2, 3, 4])):
        ways = [mutate_bytes]
        if is_text:
            ways = [mutate_bytes, mutate_words, mutate_words, mutate_digits, mutate_digits,
                    mutate_lines]
        content = rng.choice(ways)(rng, content, other)
    return content
