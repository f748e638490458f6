#!/usr/bin/env python3
"""Makes the files in corpus/: a few good ones and many that are malformed in one way each.

Run it to change the corpus; the tests only read the files. Three good JPEG pictures cannot be made
here and are kept as they are; what is wrong with the malformed ones is done to them.

corpus/EXPECTED lists the malformed files, tab separated: path, how it is read (source, classes, or
"raw FORMAT WIDTHxHEIGHT"), and a piece of the message that must come out.
"""
import pathlib
import struct
import zlib

CORPUS = pathlib.Path(__file__).resolve().parent / "corpus"
CLASS_MAX = 8

expected = []


def keep(path, data, fragment, how="source"):
    target = CORPUS / path
    target.parent.mkdir(parents=True, exist_ok=True)
    target.write_bytes(data if isinstance(data, bytes) else data.encode())
    expected.append(f"{path}\t{how}\t{fragment}")


def good(name, data):
    (CORPUS / "good" / name).write_bytes(data if isinstance(data, bytes) else data.encode())
    return data


def make_pnm():
    good("plain.pgm", "P2\n# a comment\n3 2 # another\n100\n0 50 100\n33 66 99\n")
    good("plain.ppm", "P3\n2 2\n65535\n0 32768 65535  1 2 3\n255 256 257  65535 65535 65535\n")
    good("binary.pgm", b"P5\n#\n4 3\n255\n" + bytes(range(12)))
    good("wide.pgm", b"P5 2 2 1023\n" + struct.pack(">4H", 0, 1, 512, 1023))
    good("binary.ppm", b"P6\n3 2\n255\n" + bytes(range(100, 118)))

    keep("pnm/empty.ppm", "", "the file is empty")
    keep("pnm/one_byte.ppm", "P", "neither PPM")
    keep("pnm/no_magic.ppm", "Q6\n1 1\n255\nabc", "neither PPM")
    keep("pnm/p0.ppm", "P0\n1 1\n255\nabc", "neither PPM")
    keep("pnm/p1_bitmap.pbm", "P1\n2 2\n0 1\n1 0\n", "P1 is a bitmap")
    keep("pnm/p4_bitmap.pbm", b"P4\n8 1\n\x55", "P4 is a bitmap")
    keep("pnm/p7_pam.pam", "P7\nWIDTH 1\nHEIGHT 1\nDEPTH 3\nMAXVAL 255\nENDHDR\nabc", "P7 is a PAM")
    keep("pnm/magic_only.ppm", "P6", "the width is missing")
    keep("pnm/magic_joined.ppm", "P63 2\n255\n" + "x" * 18, "a blank must follow the magic number")
    keep("pnm/no_height.ppm", "P6\n3\n", "the height is missing")
    keep("pnm/no_maxval.ppm", "P6\n3 2\n", "the maxval is missing")
    keep("pnm/header_only.ppm", "P6\n3 2\n255\n", "it ends with the header")
    keep("pnm/comment_never_ends.ppm", "P6\n3 2 # 255", "the maxval is missing")
    keep("pnm/only_comments.ppm", "P6\n# a\n# b\n", "the width is missing")
    keep("pnm/width_zero.ppm", "P6\n0 2\n255\n", "0x2; each side must be 1 to 8192")
    keep("pnm/height_zero.pgm", "P5\n2 0\n255\n", "2x0; each side must be 1 to 8192")
    keep("pnm/width_over.pgm", "P5\n8193 1\n255\n" + "x" * 8193,
         "8193x1; each side must be 1 to 8192")
    keep("pnm/height_over.pgm", "P5\n1 8193\n255\n" + "x" * 8193, "1x8193; each side")
    keep("pnm/width_huge.ppm", "P6\n99999999999999999999 1\n255\nabc", "the width is too large")
    keep("pnm/width_wraps_32_bits.ppm", "P6\n4294967297 1\n255\nabc", "the width is too large")
    keep("pnm/width_negative.ppm", "P6\n-1 1\n255\nabc", "the width must be a decimal number")
    keep("pnm/width_hex.ppm", "P6\n0x2 1\n255\nabc", "the width must be a decimal number")
    keep("pnm/width_fraction.ppm", "P6\n1.0 1\n255\nabc", "the width must be a decimal number")
    keep("pnm/height_letters.ppm", "P6\n1 one\n255\nabc", "the height must be a decimal number")
    keep("pnm/largest_promised.ppm", "P6\n8192 8192\n255\nabc", "cut short within the pixels")
    keep("pnm/maxval_zero.ppm", b"P6\n1 1\n0\n\0\0\0", "the maxval is 0; it must be 1 to 65535")
    keep("pnm/maxval_over.ppm", "P6\n1 1\n65536\nabcdef", "the maxval is 65536")
    keep("pnm/maxval_negative.pgm", "P5\n1 1\n-255\na", "the maxval must be a decimal number")
    keep("pnm/maxval_65535_cut.ppm", b"P6\n1 1\n65535\n\1\2\3\4\5", "cut short within the pixels")
    keep("pnm/p6_one_byte_short.ppm", "P6\n2 2\n255\n" + "x" * 11, "cut short within the pixels")
    keep("pnm/p5_one_byte_short.pgm", "P5\n4 4\n255\n" + "x" * 15, "cut short within the pixels")
    keep("pnm/p5_sample_over.pgm", b"P5\n3 1\n100\n\0\x64\x65",
         "a sample is 101, over the maxval 100")
    keep("pnm/p6_sample_over.ppm", b"P6\n1 1\n1\n\0\1\2", "a sample is 2, over the maxval 1")
    keep("pnm/p5_wide_sample_over.pgm", struct.pack(">12sH", b"P5\n1 1\n1023\n", 1024),
         "a sample is 1024, over the maxval 1023")
    keep("pnm/p2_sample_over.pgm", "P2\n2 1\n10\n10 11\n", "a sample is 11, over the maxval 10")
    keep("pnm/p2_sample_negative.pgm", "P2\n2 1\n10\n1 -1\n", "a sample must be a decimal number")
    keep("pnm/p2_sample_letters.pgm", "P2\n2 1\n10\n1 x\n", "a sample must be a decimal number")
    keep("pnm/p2_sample_joined.pgm", "P2\n2 1\n10\n1,2\n", "a sample must be a decimal number")
    keep("pnm/p2_too_few.pgm", "P2\n2 2\n10\n1 2 3\n",
         "line 5: the file is cut short, a sample is missing")
    keep("pnm/p3_too_few.ppm", "P3\n2 1\n255\n1 2 3 4 5\n", "a sample is missing")
    keep("pnm/p2_too_many.pgm", "P2\n2 1\n10\n1 2 3\n", "what follows is no picture")
    keep("pnm/p6_crlf_header.ppm", "P6\r\n1 1\r\n255\r\nabc", "what follows is no picture")
    keep("pnm/p5_trailing_junk.pgm", "P5\n1 1\n255\naJUNK", "what follows is no picture")
    keep("pnm/second_picture_cut.pgm", "P5\n2 1\n255\nabP5\n2 1\n255\na",
         "cut short within the pixels")
    keep("pnm/second_header_cut.pgm", "P5\n2 1\n255\nabP5\n2 ", "the height is missing")


def make_y4m():
    head420 = "YUV4MPEG2 W4 H2 F25:1 Ip A1:1 C420jpeg XCOLORRANGE=FULL\n"
    body420 = bytes(range(12))
    good("video420.y4m", (head420 + "FRAME\n").encode() + body420)
    good("video422.y4m", b"YUV4MPEG2 W4 H2 C422 XYSCSS=422\nFRAME Ip\n" + bytes(range(16)))
    good("videomono.y4m", b"YUV4MPEG2 Cmono W3 H2\nFRAME\n" + bytes(range(6)))

    def bad(name, data, fragment):
        keep("y4m/" + name, data, fragment)

    frame = b"FRAME\n" + body420
    bad("magic_only.y4m", "YUV4MPEG2", "cut short within the stream header")
    bad("magic_joined.y4m", "YUV4MPEG2W4 H2\nFRAME\n", "must begin with 'YUV4MPEG2 '")
    bad("magic_old.y4m", "YUV4MPEG W4 H2\nFRAME\n", "neither PPM")
    bad("header_never_ends.y4m", "YUV4MPEG2 W4 H2 X" + "a" * 1100, "not a line of text")
    bad("header_zero_byte.y4m", b"YUV4MPEG2 W4\0 H2\n", "not a line of text")
    bad("no_width.y4m", "YUV4MPEG2 H2\nFRAME\n", "has no W (width)")
    bad("no_height.y4m", "YUV4MPEG2 W4\nFRAME\n", "has no H (height)")
    bad("width_zero.y4m", "YUV4MPEG2 W0 H2\nFRAME\n", "W0 in the stream header; each side")
    bad("height_zero.y4m", "YUV4MPEG2 W4 H0\nFRAME\n", "H0 in the stream header; each side")
    bad("width_over.y4m", "YUV4MPEG2 W8193 H2\nFRAME\n", "W8193 in the stream header")
    bad("width_huge.y4m", "YUV4MPEG2 W4294967300 H2\nFRAME\n", "W4294967300 in the stream header")
    bad("width_negative.y4m", "YUV4MPEG2 W-4 H2\nFRAME\n", "W-4 in the stream header")
    bad("width_empty.y4m", "YUV4MPEG2 W H2\nFRAME\n", "W in the stream header")
    bad("odd_width_422.y4m", b"YUV4MPEG2 W3 H2 C422\nFRAME\n" + bytes(16),
        "4:2:2 needs an even width")
    bad("odd_width_420.y4m", b"YUV4MPEG2 W3 H2 C420\nFRAME\n" + bytes(10),
        "4:2:0 an even width and height")
    bad("odd_height_420.y4m", b"YUV4MPEG2 W4 H3 C420\nFRAME\n" + bytes(20),
        "4:2:0 an even width and height")
    bad("chroma_444.y4m", b"YUV4MPEG2 W4 H2 C444\nFRAME\n" + bytes(24), "chroma 'C444' is not read")
    bad("chroma_411.y4m", b"YUV4MPEG2 W4 H2 C411\nFRAME\n" + bytes(12), "chroma 'C411' is not read")
    bad("chroma_10_bits.y4m", b"YUV4MPEG2 W4 H2 C420p10\nFRAME\n" + bytes(24),
        "chroma 'C420p10' is not read")
    bad("range_unknown.y4m", "YUV4MPEG2 W4 H2 XCOLORRANGE=HALF\nFRAME\n",
        "unknown colour range 'XCOLORRANGE=HALF'")
    bad("no_frame.y4m", head420, "it has no frame")
    bad("frame_header_wrong.y4m", head420.encode() + b"FRAMES\n" + body420,
        "must begin with a line 'FRAME'")
    bad("frame_header_missing.y4m", head420.encode() + b"\n" + body420,
        "must begin with a line 'FRAME'")
    bad("frame_header_cut.y4m", head420 + "FRA", "cut short within a frame header")
    bad("frame_one_byte_short.y4m", (head420.encode() + frame)[:-1], "frame 0 is cut short")
    bad("second_frame_short.y4m", head420.encode() + frame + frame[:-3], "frame 1 is cut short")
    bad("trailing_junk.y4m", head420.encode() + frame + b"junk\n",
        "frame 1 must begin with a line 'FRAME'")
    bad("largest_promised.y4m", "YUV4MPEG2 W8192 H8192 C422\nFRAME\nabc", "frame 0 is cut short")


def make_raw():
    keep("raw/half_a_frame.raw", bytes(8),
         "frame 0 is cut short: YUYV frames of 4x2 take 16 bytes, it has 8",
         "raw YUYV 4x2")
    keep("raw/second_frame_short.raw", bytes(31), "frame 1 is cut short", "raw YUYV 4x2")
    keep("raw/one_byte_over.raw", bytes(13),
         "frame 1 is cut short: I420 frames of 4x2 take 12 bytes, it has 1",
         "raw I420 4x2")
    keep("raw/empty.raw", b"", "the file is empty", "raw GRAY8 1x1")
    keep("raw/odd_width_422.raw", bytes(12), "cannot be 3x2", "raw UYVY 3x2")
    keep("raw/odd_height_420.raw", bytes(18), "cannot be 4x3", "raw NV12 4x3")
    keep("raw/odd_bayer.raw", bytes(9), "cannot be 3x3", "raw BAYER8_GRBG 3x3")
    keep("raw/size_zero.raw", bytes(4), "cannot be 0x4", "raw GRAY8 0x4")
    keep("raw/size_over.raw", bytes(4), "cannot be 65537x1", "raw GRAY8 65537x1")


def chunk(kind, data, crc=None):
    crc = zlib.crc32(kind + data) if crc is None else crc
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", crc)


SIGNATURE = b"\x89PNG\r\n\x1a\n"


def png(width, height, depth, color, rows, *, interlace=0, before=b"", end=True):
    head = struct.pack(">IIBBBBB", width, height, depth, color, 0, 0, interlace)
    return (SIGNATURE + chunk(b"IHDR", head) + before + chunk(b"IDAT", zlib.compress(rows))
            + (chunk(b"IEND", b"") if end else b""))


def make_png():
    rgb = b"".join(b"\0" + bytes(range(10 * y, 10 * y + 9)) for y in range(2))
    good("rgb.png", png(3, 2, 8, 2, rgb))
    good("gray.png", png(3, 2, 8, 0, b"\0\x00\x7f\xff\0\x01\x02\x03"))
    good("gray16.png", png(2, 1, 16, 0, b"\0" + struct.pack(">2H", 32767, 65535)))
    good("gray1.png", png(8, 1, 1, 0, b"\0\xa5"))
    good("grayalpha.png", png(2, 1, 8, 4, b"\0\x10\x80\x20\x00"))
    good("rgba.png", png(1, 1, 8, 6, b"\0\x01\x02\x03\x00"))
    good("palette.png",
         png(2, 1, 8, 3, b"\0\x01\x00", before=chunk(b"PLTE", b"\x0a\x0b\x0c\x14\x15\x16")
                            + chunk(b"tRNS", b"\x80")))
    # Adam7, 2x2: pass 1 has (0, 0), pass 6 has (1, 0), pass 7 has row 1.
    good("interlaced.png", png(2, 2, 8, 0, b"\0\x01\0\x02\0\x03\x04", interlace=1))

    def bad(name, data, fragment):
        keep("png/" + name, data, fragment)

    whole = png(3, 2, 8, 2, rgb)
    bad("signature_only.png", SIGNATURE, "the file is cut short")
    bad("signature_newlines.png", whole.replace(b"\r\n", b"\n", 1), "PNG: ")
    bad("header_crc.png", whole[:29] + b"\0\0\0\0" + whole[33:], "PNG: ")
    bad("width_zero.png", png(0, 2, 8, 2, rgb), "PNG: ")
    bad("height_zero.png", png(3, 0, 8, 2, rgb), "PNG: ")
    bad("width_over.png", png(8193, 1, 8, 0, bytes(8194)), "8193x1; each side must be 1 to 8192")
    bad("height_huge.png", png(1, 2**31 - 1, 8, 0, bytes(2)), "each side must be 1 to 8192")
    bad("width_negative.png", png(2**31 + 3, 2, 8, 2, rgb), "PNG: ")
    bad("depth_3.png", png(3, 2, 3, 0, rgb), "PNG: ")
    bad("depth_16_palette.png", png(3, 2, 16, 3, rgb), "PNG: ")
    bad("color_type_5.png", png(3, 2, 8, 5, rgb), "PNG: ")
    bad("interlace_2.png", png(3, 2, 8, 2, rgb, interlace=2), "PNG: ")
    bad("palette_missing.png", png(2, 1, 8, 3, b"\0\0\0"), "PNG: ")
    bad("no_pixels.png", SIGNATURE + chunk(b"IHDR", struct.pack(">IIBBBBB", 3, 2, 8, 2, 0, 0, 0))
        + chunk(b"IEND", b""), "PNG: ")
    bad("no_header.png", SIGNATURE + chunk(b"IDAT", zlib.compress(rgb)) + chunk(b"IEND", b""),
        "PNG: ")
    bad("rows_missing.png", png(3, 3, 8, 2, rgb), "PNG: ")
    bad("filter_9.png", png(3, 2, 8, 2, b"\x09" + rgb[1:]), "PNG: ")
    bad("pixels_not_zlib.png", whole.replace(zlib.compress(rgb), b"x" * len(zlib.compress(rgb))),
        "PNG: ")
    bad("pixels_crc.png", whole[:-16] + b"\0\0\0\0" + whole[-12:], "PNG: ")
    bad("no_end.png", png(3, 2, 8, 2, rgb, end=False), "the file is cut short")
    bad("chunk_length_huge.png", whole[:33] + b"\xff\xff\xff\xff" + whole[37:], "PNG: ")
    bad("largest_interlaced_promised.png", png(8192, 8192, 8, 2, b"", interlace=1), "PNG: ")
    bad("trailing_junk.png", whole + b"junk", "what follows is no picture")


def make_jpeg():
    gray = (CORPUS / "good" / "gray.jpg").read_bytes()
    color = (CORPUS / "good" / "color.jpg").read_bytes()

    def bad(name, data, fragment):
        keep("jpeg/" + name, data, fragment)

    def with_size(height, width):
        at = color.index(b"\xff\xc0")
        return color[:at + 5] + struct.pack(">HH", height, width) + color[at + 9:]

    tables = color.index(b"\xff\xdb")
    huffman = color.index(b"\xff\xc4")
    scan = color.index(b"\xff\xda")
    # Video cameras leave the standard Huffman tables out; that is no fault.
    good("motion.jpg", color[:huffman] + color[scan:])
    bad("start_only.jpg", b"\xff\xd8\xff", "the file is cut short")
    bad("no_tables.jpg", color[:tables] + color[color.index(b"\xff\xc0"):], "JPEG: ")
    bad("huffman_counts.jpg", color[:huffman + 5] + b"\xff" * 16 + color[huffman + 21:], "JPEG: ")
    bad("no_scan.jpg", color[:scan] + b"\xff\xd9", "JPEG: ")
    bad("half.jpg", color[:scan + (len(color) - scan) // 2], "the file is cut short")
    bad("no_end.jpg", color[:-2], "the file is cut short")
    bad("width_zero.jpg", with_size(16, 0), "JPEG: ")
    bad("height_zero.jpg", with_size(0, 16), "JPEG: ")
    bad("width_over.jpg", with_size(16, 8193), "8193x16; each side must be 1 to 8192")
    bad("largest_promised.jpg", with_size(8192, 8192), "JPEG: ")
    bad("end_too_early.jpg", color[:scan + 20] + b"\xff\xd9", "JPEG: ")
    bad("twice_the_start.jpg", b"\xff\xd8" + color, "JPEG: ")
    bad("precision_12.jpg", color.replace(b"\xff\xc0\x00\x11\x08", b"\xff\xc0\x00\x11\x0c"),
        "JPEG: ")
    bad("cmyk.jpg", gray.replace(b"\xff\xc0\x00\x0b\x08\x00\x10\x00\x10\x01\x01\x11\x00",
                                 b"\xff\xc0\x00\x14\x08\x00\x10\x00\x10\x04\x01\x11\x00\x02\x11\x00"
                                 b"\x03\x11\x00\x04\x11\x00"), "neither gray nor YCbCr nor RGB")


COLORS = "[Colors]\n(255,128,  0) 0.5000 5 orange\n(  0,  0,255) 0.25 1 blue\n"
THRESHOLDS = "\n[Thresholds]\n( 40:200, 90:120,150:200)\n(  0:255,128:255,  0:127)\n"


def make_classes():
    good("two.classes", "#! range limited\n\n" + COLORS + THRESHOLDS)

    def bad(name, data, fragment):
        keep("classes/" + name, data, fragment, "classes")

    def color(line):
        return "[Colors]\n" + line + "\n" + "\n[Thresholds]\n(1:2,3:4,5:6)\n"

    def threshold(line):
        return "[Colors]\n(1,2,3) 0.5 1 a\n\n[Thresholds]\n" + line + "\n"

    bad("empty.classes", "", "the file is empty")
    bad("no_colors.classes", THRESHOLDS, "there is no section [Colors]")
    bad("colors_misspelt.classes", COLORS.replace("Colors", "Colours") + THRESHOLDS,
        "there is no section [Colors]")
    bad("colors_empty.classes", "[Colors]\n\n[Thresholds]\n", "[Colors] has no entry")
    bad("no_thresholds.classes", COLORS, "there is no section [Thresholds]")
    bad("thresholds_misspelt.classes", COLORS + THRESHOLDS.replace("Thresholds", "Threshold"),
        "there is no section [Thresholds]")
    bad("threshold_missing.classes", COLORS + "\n[Thresholds]\n(1:2,3:4,5:6)\n",
        "colour 'blue' has no thresholds: [Colors] has 2 entries, [Thresholds] 1")
    bad("threshold_without_color.classes", COLORS + THRESHOLDS + "(1:2,3:4,5:6)\n",
        "line 8: these thresholds have no colour")
    bad("nine_thresholds.classes", "[Colors]\n" + "(1,2,3) 0 1 a\n" * CLASS_MAX + "[Thresholds]\n"
        + "(1:2,3:4,5:6)\n" * (CLASS_MAX + 1),
        f"line {2 * CLASS_MAX + 3}: these thresholds have no colour")
    bad("nine_colors.classes", "[Colors]\n" + "(1,2,3) 0 1 a\n" * (CLASS_MAX + 1) + "[Thresholds]\n"
        + "(1:2,3:4,5:6)\n" * (CLASS_MAX + 1),
        "line 10: this program was built for at most 8 classes")
    bad("colors_twice.classes", COLORS + THRESHOLDS + COLORS, "a second time; join the two")
    bad("thresholds_twice.classes", COLORS + THRESHOLDS + THRESHOLDS, "a second time; join the two")
    bad("display_color_256.classes", color("(256,0,0) 0.5 1 a"),
        "line 2: 256 is out of range, write 0 to 255")
    bad("display_color_negative.classes", color("(-1,0,0) 0.5 1 a"), "line 2: -1 is out of range")
    bad("display_color_two_numbers.classes", color("(1,2) 0.5 1 a"),
        "a colour reads '(RED,GREEN,BLUE)")
    bad("display_color_open.classes", color("(1,2,3 0.5 1 a"), "a colour reads '(RED,GREEN,BLUE)")
    bad("display_color_letters.classes", color("(red,2,3) 0.5 1 a"),
        "a colour reads '(RED,GREEN,BLUE)")
    bad("merge_missing.classes", color("(1,2,3) orange"), "the merge density must be a number")
    bad("merge_negative.classes", color("(1,2,3) -0.5 1 a"), "the merge density must be a number")
    bad("merge_nan.classes", color("(1,2,3) nan 1 a"), "the merge density must be a number")
    bad("merge_infinite.classes", color("(1,2,3) 1e999 1 a"), "the merge density must be a number")
    bad("merge_two_points.classes", color("(1,2,3) 0.5.1 1 a"),
        "the merge density must be a number")
    bad("expected_missing.classes", color("(1,2,3) 0.5 orange"),
        "the expected number of blobs must be")
    bad("expected_negative.classes", color("(1,2,3) 0.5 -1 a"),
        "the expected number of blobs must be")
    bad("expected_huge.classes", color("(1,2,3) 0.5 99999999999999999999 a"),
        "the expected number of blobs must be")
    bad("expected_joined.classes", color("(1,2,3) 0.5 1a"), "the expected number of blobs must be")
    bad("name_missing.classes", color("(1,2,3) 0.5 1"), "the colour has no name")
    bad("name_64_long.classes", color("(1,2,3) 0.5 1 " + "n" * 64),
        "the name is longer than 63 characters")
    bad("threshold_256.classes", threshold("(0:256,0:255,0:255)"),
        "line 5: 256 is out of range, write 0 to 255")
    bad("threshold_negative.classes", threshold("(0:5,-3:9,0:255)"), "line 5: -3 is out of range")
    bad("threshold_wraps.classes", threshold("(0:4294967300,3:9,0:255)"),
        "line 5: 4294967300 is out of range")
    bad("y_min_over_max.classes", threshold("(6:5,0:255,0:255)"), "a minimum is over its maximum")
    bad("u_min_over_max.classes", threshold("(0:255,200:100,0:255)"),
        "a minimum is over its maximum")
    bad("v_min_over_max.classes", threshold("(0:255,0:255,1:0)"), "a minimum is over its maximum")
    bad("threshold_commas.classes", threshold("(1,2,3,4,5,6)"), "thresholds read '(YMIN:YMAX")
    bad("threshold_four_numbers.classes", threshold("(1:2,3:4)"), "thresholds read '(YMIN:YMAX")
    bad("threshold_open.classes", threshold("(1:2,3:4,5:6"), "thresholds read '(YMIN:YMAX")
    bad("threshold_letters.classes", threshold("(a:b,c:d,e:f)"), "thresholds read '(YMIN:YMAX")
    bad("text_within_section.classes", threshold("orange is nice"),
        "line 5: neither an entry '(...)'")
    bad("range_unknown.classes", "#! range half\n" + COLORS + THRESHOLDS,
        "unknown colour range 'half'")
    bad("range_empty.classes", "#! range\n" + COLORS + THRESHOLDS, "unknown colour range ''")
    bad("range_twice.classes", "#! range full\n#! range full\n" + COLORS + THRESHOLDS,
        "line 2: the colour range is given a second time")
    bad("addition_unknown.classes", "#! gamma 2.2\n" + COLORS + THRESHOLDS,
        "'#!' is followed by 'range full'")
    bad("zero_byte.classes", COLORS.encode() + b"\0\n" + THRESHOLDS.encode(),
        "line 4: a control character")
    bad("binary.classes", bytes(range(1, 200)), "a control character")
    bad("carriage_return_within.classes", (COLORS + THRESHOLDS).replace("\n", "\r"),
        "a control character")
    bad("line_256_long.classes", "#" + "c" * 255 + "\n" + COLORS + THRESHOLDS,
        "line 1: longer than 255 characters")


def make_tables():
    cells = bytearray(4 * 8 * 8)
    cells[5:9] = b"\1\2\2\3"
    table = b"TMAP\nYUV8\n4 8 8\n" + bytes(cells)
    good("small.tm", table)

    def bad(name, data, fragment):
        keep("tm/" + name, data, fragment, "classes")

    bad("magic_only.tm", "TMAP", "cut short within the header")
    bad("magic_joined.tm", b"TMAPS\nYUV8\n4 8 8\n" + bytes(cells), "the first line must be 'TMAP'")
    bad("kind_rgb.tm", b"TMAP\nRGB8\n4 8 8\n" + bytes(cells), "the table is of kind 'RGB8'")
    bad("size_missing.tm", b"TMAP\nYUV8\n", "cut short within the header")
    bad("size_two_numbers.tm", b"TMAP\nYUV8\n16 64\n" + bytes(cells), "three powers of two")
    bad("size_four_numbers.tm", b"TMAP\nYUV8\n4 8 8 8\n" + bytes(cells), "three powers of two")
    bad("size_zero.tm", b"TMAP\nYUV8\n0 64 64\n" + bytes(cells), "three powers of two")
    bad("size_not_power_of_two.tm", b"TMAP\nYUV8\n4 7 8\n" + bytes(4 * 7 * 8),
        "three powers of two")
    bad("size_over_256.tm", b"TMAP\nYUV8\n512 1 1\n" + bytes(512), "three powers of two")
    bad("size_negative.tm", b"TMAP\nYUV8\n-4 8 8\n" + bytes(cells), "three powers of two")
    bad("size_huge.tm", b"TMAP\nYUV8\n99999999999999999999 1 1\n\0", "three powers of two")
    bad("header_never_ends.tm", b"TMAP\n" + b"Y" * 100, "the header must be three lines")
    bad("one_cell_short.tm", table[:-1], "cut short: 255 of 256 cells")
    bad("one_cell_over.tm", table + b"\1", "behind the 256 cells")
    bad("label_9.tm", table[:-1] + b"\x09", "has label 9, but this program was built for at most 8")
    bad("all_background.tm", b"TMAP\nYUV8\n4 8 8\n" + bytes(256), "every label of the table is 0")
    bad("largest_promised.tm", b"TMAP\nYUV8\n256 256 256\n" + bytes(10),
        "cut short: 10 of 16777216 cells")


def main():
    (CORPUS / "good").mkdir(parents=True, exist_ok=True)
    for make in (make_pnm, make_y4m, make_raw, make_png, make_jpeg, make_classes, make_tables):
        make()
    (CORPUS / "EXPECTED").write_text("\n".join(expected) + "\n")
    print(f"{len(expected)} malformed files")


main()
