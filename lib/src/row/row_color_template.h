/*
 * Rows of colours in vectors, whatever the processor. The file that includes this one says what the
 * words mean:
 *     vec, LANES               a vector and its bytes
 *     three                    a vector of each of three channels
 *     load, store              a vector of bytes
 *     load3, store3            bytes of three channels by turns
 *     full_ycbcr(rgb)          full range, exact
 *     formed(channels, form, &doubt)
 *                              the linear forms of row_color.h; doubt becomes true where plain C
 *                              must say
 *     rgb565_at, bayer_at      R, G and B of 16-bit pixels, of a mosaic
 *     pairs_at(src, x)         Y, U and V of pairs, x even
 *     tables, tables_of        the nibble tables of a channel
 *     class_masks(tables, values), both(masks, masks), labels_of_masks(masks)
 *                              from values to masks, their AND, and labels
 *     is_zero                  whether a vector is 0
 *     ISA, INLINE, KERNEL      for what a function is compiled, what it is called
 *     APART                    never inlined: its memory is not the caller's
 *
 *     NARROWER(name)           if defined, a kernel of narrower vectors for the rest of a row
 *
 * Else the pixels behind the last whole vector are read by plain C into a vector's memory.
 */

static const pel_row_form form_ycbcr = PEL_ROW_FORM_YCBCR;
static const pel_row_form form_rgb_full = PEL_ROW_FORM_RGB_FULL;
static const pel_row_form form_rgb_limited = PEL_ROW_FORM_RGB_LIMITED;

/* ---- Conversions --------------------------------------------------------------------------- */

APART void ycbcr_in_plain_c(three *t)
{
    uint8_t bytes[3 * LANES];

    store3(bytes, *t);
    pel_row_rgb_to_ycbcr(bytes, LANES, 1, bytes, bytes + 1, bytes + 2, 3);
    *t = load3(bytes);
}

APART void rgb_in_plain_c(int limited, three *t)
{
    uint8_t bytes[3 * LANES];

    store3(bytes, *t);
    pel_row_ycbcr_to_rgb(bytes, bytes + 1, bytes + 2, 3, LANES, limited, bytes);
    *t = load3(bytes);
}

/* In place. Forms are long: there is one of each. */
APART void to_limited_ycbcr(three *t)
{
    int doubt;
    const three ycbcr = formed(*t, &form_ycbcr, &doubt);

    if (doubt) {
        ycbcr_in_plain_c(t);
    } else {
        *t = ycbcr;
    }
}

APART void full_to_rgb(three *t)
{
    int doubt;
    const three rgb = formed(*t, &form_rgb_full, &doubt);

    if (doubt) {
        rgb_in_plain_c(0, t);
    } else {
        *t = rgb;
    }
}

APART void limited_to_rgb(three *t)
{
    int doubt;
    const three rgb = formed(*t, &form_rgb_limited, &doubt);

    if (doubt) {
        rgb_in_plain_c(1, t);
    } else {
        *t = rgb;
    }
}

INLINE three ycbcr_of(three rgb, int limited)
{
    if (limited) {
        to_limited_ycbcr(&rgb);
        return rgb;
    }
    return full_ycbcr(rgb);
}

INLINE three rgb_of(three ycbcr, int limited)
{
    if (limited) {
        limited_to_rgb(&ycbcr);
    } else {
        full_to_rgb(&ycbcr);
    }
    return ycbcr;
}

/* ---- Places -------------------------------------------------------------------------------- */

INLINE void put(three t, const pel_row_places *dst, size_t x)
{
    if (dst->step == 3) {
        store3(dst->a + 3 * x, t);
    } else {
        store(dst->a + x, t.a);
        store(dst->b + x, t.b);
        store(dst->c + x, t.c);
    }
}

#if !defined(NARROWER)
/* Packed pixels to their places from x on. */
static void put_bytes(const uint8_t *packed, unsigned count, const pel_row_places *dst, size_t x)
{
    for (size_t i = 0; i < count; i++) {
        const size_t at = (x + i) * dst->step;
        dst->a[at] = packed[3 * i];
        dst->b[at] = packed[3 * i + 1];
        dst->c[at] = packed[3 * i + 2];
    }
}

static pel_row_places packed_places(uint8_t *bytes)
{
    const pel_row_places places = {bytes, bytes + 1, bytes + 2, 3};
    return places;
}
#endif

/* ---- Colours ------------------------------------------------------------------------------- */

INLINE three colors_at(const pel_row_colors *src, size_t x)
{
    if (src->kind == PEL_ROW_RGB24) {
        const three t = load3(src->bytes + 3 * x);
        const three turned = {t.c, t.b, t.a};
        return src->order == 0 ? t : turned;
    }
    if (src->kind == PEL_ROW_RGB565) {
        return rgb565_at(src->bytes + 2 * x, src->order);
    }
    return bayer_at(src->bytes + 2 * x, src->odd + 2 * x, src->order);
}

#if defined(NARROWER)
static pel_row_colors colors_from(const pel_row_colors *src, size_t x)
{
    const pel_row_colors rest = {src->bytes + (src->kind == PEL_ROW_RGB24 ? 3 : 2) * x,
                                 src->kind == PEL_ROW_BAYER ? src->odd + 2 * x : NULL, src->kind,
                                 src->order};
    return rest;
}

static void last_to_ycbcr(const pel_row_colors *src, size_t x, uint16_t count, int limited,
                          const pel_row_places *dst)
{
    const size_t skip = x * dst->step;
    const pel_row_colors rest = colors_from(src, x);
    const pel_row_places places = {dst->a + skip, dst->b + skip, dst->c + skip, dst->step};
    NARROWER(colors_to_ycbcr)(&rest, count, limited, &places);
}

static void last_colors(const pel_row_colors *src, size_t x, uint16_t count, uint8_t *rgb)
{
    const pel_row_colors rest = colors_from(src, x);
    NARROWER(colors_to_rgb)(&rest, count, rgb);
}
#else
/* The last pixels, fewer than a vector, as R G B. */
static void read_last(const pel_row_colors *src, size_t x, uint16_t count, uint8_t *rgb)
{
    if (src->kind == PEL_ROW_RGB24) {
        pel_row_read_rgb24(src->bytes + 3 * x, count, src->order, rgb);
    } else if (src->kind == PEL_ROW_RGB565) {
        pel_row_read_rgb565(src->bytes + 2 * x, count, src->order, rgb);
    } else {
        pel_row_read_bayer(src->bytes + 2 * x, src->odd + 2 * x, count, src->order, rgb);
    }
}

APART void last_to_ycbcr(const pel_row_colors *src, size_t x, uint16_t count, int limited,
                         const pel_row_places *dst)
{
    uint8_t bytes[3 * LANES] = {0};

    read_last(src, x, count, bytes);
    store3(bytes, ycbcr_of(load3(bytes), limited));
    put_bytes(bytes, count, dst, x);
}

static void last_colors(const pel_row_colors *src, size_t x, uint16_t count, uint8_t *rgb)
{
    read_last(src, x, count, rgb);
}
#endif

ISA void KERNEL(colors_to_ycbcr)(const pel_row_colors *src, uint16_t count, int limited,
                                 const pel_row_places *dst)
{
    size_t x = 0;

    for (; x + LANES <= count; x += LANES) {
        put(ycbcr_of(colors_at(src, x), limited), dst, x);
    }
    if (x < count) {
        last_to_ycbcr(src, x, (uint16_t)(count - x), limited, dst);
    }
}

ISA void KERNEL(colors_to_rgb)(const pel_row_colors *src, uint16_t count, uint8_t *rgb)
{
    size_t x = 0;

    for (; x + LANES <= count; x += LANES) {
        store3(rgb + 3 * x, colors_at(src, x));
    }
    if (x < count) {
        last_colors(src, x, (uint16_t)(count - x), rgb + 3 * x);
    }
}

/* ---- Pairs --------------------------------------------------------------------------------- */

#if defined(NARROWER)
static pel_row_pairs pairs_from(const pel_row_pairs *src, size_t x)
{
    const size_t skip = x / 2 * src->c_step;
    const pel_row_pairs rest = {src->y + x * src->y_step, src->u + skip, src->v + skip, src->y_step,
                                src->c_step};
    return rest;
}

static void last_pairs_to_planes(const pel_row_pairs *src, size_t x, uint16_t count,
                                 const pel_row_places *dst)
{
    const pel_row_pairs rest = pairs_from(src, x);
    const pel_row_places places = {dst->a + x, dst->b + x, dst->c + x, 1};
    NARROWER(pairs_to_planes)(&rest, count, &places);
}

static void last_to_rgb(const uint8_t *ycbcr, uint16_t count, int limited, uint8_t *rgb)
{
    NARROWER(ycbcr_to_rgb)(ycbcr, count, limited, rgb);
}

static void last_pairs_to_rgb(const pel_row_pairs *src, size_t x, uint16_t count, int limited,
                              uint8_t *rgb)
{
    const pel_row_pairs rest = pairs_from(src, x);
    NARROWER(pairs_to_rgb)(&rest, count, limited, rgb + 3 * x);
}
#else
static void last_pairs_to_planes(const pel_row_pairs *src, size_t x, uint16_t count,
                                 const pel_row_places *dst)
{
    pel_row_read_pairs(src, (uint16_t)x, count, dst->a + x, dst->b + x, dst->c + x);
}

APART void last_to_rgb(const uint8_t *ycbcr, uint16_t count, int limited, uint8_t *rgb)
{
    uint8_t bytes[3 * LANES] = {0};
    const pel_row_places in = packed_places(bytes), out = packed_places(rgb);

    put_bytes(ycbcr, count, &in, 0);
    store3(bytes, rgb_of(load3(bytes), limited));
    put_bytes(bytes, count, &out, 0);
}

APART void last_pairs_to_rgb(const pel_row_pairs *src, size_t x, uint16_t count, int limited,
                             uint8_t *rgb)
{
    uint8_t planes[3 * LANES] = {0};
    const pel_row_places out = packed_places(rgb);

    pel_row_read_pairs(src, (uint16_t)x, count, planes, planes + LANES, planes + 2 * LANES);
    three last = {load(planes), load(planes + LANES), load(planes + 2 * LANES)};
    store3(planes, rgb_of(last, limited));
    put_bytes(planes, count, &out, x);
}
#endif

ISA void KERNEL(pairs_to_planes)(const pel_row_pairs *src, uint16_t count,
                                 const pel_row_places *dst)
{
    size_t x = 0;

    for (; x + LANES <= count; x += LANES) {
        put(pairs_at(src, x), dst, x);
    }
    if (x < count) {
        last_pairs_to_planes(src, x, (uint16_t)(count - x), dst);
    }
}

ISA void KERNEL(pairs_to_rgb)(const pel_row_pairs *src, uint16_t count, int limited, uint8_t *rgb)
{
    size_t x = 0;

    for (; x + LANES <= count; x += LANES) {
        store3(rgb + 3 * x, rgb_of(pairs_at(src, x), limited));
    }
    if (x < count) {
        last_pairs_to_rgb(src, x, (uint16_t)(count - x), limited, rgb);
    }
}

ISA void KERNEL(ycbcr_to_rgb)(const uint8_t *ycbcr, uint16_t count, int limited, uint8_t *rgb)
{
    size_t x = 0;

    for (; x + LANES <= count; x += LANES) {
        store3(rgb + 3 * x, rgb_of(load3(ycbcr + 3 * x), limited));
    }
    if (x < count) {
        last_to_rgb(ycbcr + 3 * x, (uint16_t)(count - x), limited, rgb + 3 * x);
    }
}

/* ---- Classes ------------------------------------------------------------------------------- */

/* Most pixels are background, most of them by their chroma alone. */
ISA uint16_t KERNEL(classify_planes)(const uint8_t *nibbles, const uint8_t *y, const uint8_t *u,
                                     const uint8_t *v, uint16_t count, uint8_t *labels)
{
    const tables of_u = tables_of(nibbles + PEL_NIBBLES_CHANNEL);
    const tables of_v = tables_of(nibbles + 2 * PEL_NIBBLES_CHANNEL);
    size_t x = 0;

    for (; x + LANES <= count; x += LANES) {
        const vec by_chroma =
            both(class_masks(&of_u, load(u + x)), class_masks(&of_v, load(v + x)));
        if (is_zero(by_chroma)) {
            store(labels + x, by_chroma);
        } else {
            const tables of_y = tables_of(nibbles);
            store(labels + x, labels_of_masks(both(by_chroma, class_masks(&of_y, load(y + x)))));
        }
    }
    return (uint16_t)x;
}
