#!/bin/sh
# Shows every operator of `pel` on a small picture: joins the results into strips, operators/*.png,
# lists the commands that made them in operators.md, and writes the table of the README.
#     gallery.sh [FOLDER]      default: tools/demo
# PEL_COMMAND is the command to use, default: pel.
set -eu

root=$(cd "$(dirname "$0")/../.." && pwd)
folder=$(cd "${1:-$root/tools/demo}" && pwd)
pel=${PEL_COMMAND:-pel}
columns=8
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"

# coarse IN OUT: 16 steps a channel, which makes a PNG small.
coarse() {
    "$pel" point linear 0 240 "$1" steps.ppm
    "$pel" point and steps.ppm "$1" "$2"
}

# The picture that all operators get, without noise, and a second one where two are needed.
"$pel" filter median --repeat 6 "$root/tools/demo/robot.ppm" quiet.ppm
"$pel" point resize 160x120 --box quiet.ppm half.ppm
"$pel" point resize 112x84 half.ppm small.ppm
coarse small.ppm in.ppm
"$pel" point threshold 120 in.ppm mask.pgm
"$pel" point adaptive 3 2 in.ppm speckled.pgm

count=0
rows=''
# make NAME WORD...: runs pel WORD... and takes out.ppm as the next picture.
make() {
    label=$1
    shift
    "$pel" "$@"
    number=$(printf '%03d' "$count")
    mv out.ppm "cell$number.ppm"
    line="| $((count / columns + 1)), $((count % columns + 1)) | $label | \`pel $*\` |"
    rows="$rows$line
"
    count=$((count + 1))
}

# signed NAME SHIFT: a filter whose results have a sign, around middle gray.
signed() {
    make "$1" filter "$1" --gray --shift "$2" --bias 128 in.ppm out.ppm
}

make 'the picture itself' convert in.ppm out.ppm
for name in $("$pel" filter --list | cut -d ' ' -f 1); do
    case $name in
        sobel-* | prewitt-*)
            make "$name" filter "$name" --gray --shift 2 --bias 128 in.ppm out.ppm
            ;;
        scharr-*) make "$name" filter "$name" --gray --shift 4 --bias 128 in.ppm out.ppm ;;
        laplacian*) make "$name" filter "$name" --gray --shift 1 --bias 128 in.ppm out.ppm ;;
        shift-*) make "$name" filter "$name" --repeat 12 --border wrap in.ppm out.ppm ;;
        identity) make "$name" filter "$name" in.ppm out.ppm ;;
        gradient* | direction) make "$name" filter "$name" --gray in.ppm out.ppm ;;
        median) make "$name" filter "$name" --repeat 3 in.ppm out.ppm ;;
        erode | dilate | open | close) make "$name" filter "$name" --repeat 2 in.ppm out.ppm ;;
        majority | *-labels) make "$name" filter "$name" speckled.pgm out.ppm ;;
        box* | gauss* | binomial*) make "$name" filter "$name" --repeat 3 in.ppm out.ppm ;;
        *) make "$name" filter "$name" in.ppm out.ppm ;;
    esac
done
make 'a kernel of your own' filter --kernel '0 0 1 0 0 0 -1 0 0' --gray --bias 128 in.ppm out.ppm
for name in $("$pel" point --list | cut -d ' ' -f 1); do
    case $name in
        brightness) make "$name" point "$name" 60 in.ppm out.ppm ;;
        contrast) make "$name" point "$name" 1.8 --pivot mean in.ppm out.ppm ;;
        linear) make "$name" point "$name" -0.5 200 in.ppm out.ppm ;;
        stretch) make "$name" point "$name" 1 99 in.ppm out.ppm ;;
        gamma-exponent) make "$name" point "$name" 3/4 in.ppm out.ppm ;;
        gamma-*) make "$name" point "$name" 2.2 in.ppm out.ppm ;;
        threshold) make "$name" point "$name" 120 in.ppm out.ppm ;;
        adaptive) make "$name" point "$name" 3 2 in.ppm out.ppm ;;
        resize)
            make "$name, box" point "$name" 56x42 --box in.ppm out.ppm
            make "$name, bilinear" point "$name" 90x68 in.ppm out.ppm
            make "$name, nearest" point "$name" 90x68 --nearest in.ppm out.ppm
            ;;
        white-balance)
            make "$name, gray world" point "$name" --gray-world in.ppm out.ppm
            make "$name, patch" point "$name" --patch 12,2,22,8 in.ppm out.ppm
            ;;
        blend) make "$name" point "$name" 0.5 mask.pgm in.ppm out.ppm ;;
        add | subtract | absdiff | min | max | and | or | xor)
            make "$name" point "$name" mask.pgm in.ppm out.ppm
            ;;
        *) make "$name" point "$name" in.ppm out.ppm ;;
    esac
done
for method in harris shi-tomasi fast; do
    make "corners, $method" corners --method $method --max 15 -o out.ppm in.ppm > list.txt
done
make 'edges' edges in.ppm out.ppm
make 'edges, linked by rows' edges --link rows in.ppm out.ppm
make 'edges, not linked' edges --link none in.ppm out.ppm
make 'line' line --columns --length 1-4 --roi 0,40,112,56 -o out.ppm mask.pgm > list.txt
"$pel" histogram -o histogram.ppm "$root/tools/demo/robot.ppm" > list.txt
make 'histogram (of robot.ppm)' point resize 112x56 histogram.ppm out.ppm

# A strip of pictures for each row, and the table that the README shows.
rm -f "$folder"/operators/*.png
mkdir -p "$folder/operators"
{
    printf '| made by `pel`, from left to right | operators |\n|---|---|\n'
    first=0
    while [ "$first" -lt "$count" ]; do
        strip=$((first / columns + 1))
        cells=''
        for number in $(seq "$first" $((first + columns - 1))); do
            cell=$(printf 'cell%03d.ppm' "$number")
            [ ! -f "$cell" ] || cells="$cells $cell"
        done
        # shellcheck disable=SC2086 # the names have no blanks
        "$pel" sheet --columns "$columns" --gap 2 strip.ppm $cells
        coarse strip.ppm "$folder/operators/$strip.png"
        names=$(printf '%s' "$rows" | sed -n "s/^| $strip, [0-9]* | \\([^|]*\\) | .*/\\1/p" |
            sed ':a;N;$!ba;s/\n/ · /g')
        printf '| ![row %s](tools/demo/operators/%s.png) | %s |\n' "$strip" "$strip" "$names"
        first=$((first + columns))
    done
} > table.md
{
    printf 'Row and place in operators/ROW.png, and the command that made it. in.ppm is robot.ppm\n'
    printf 'without noise, small, and in 16 steps a channel, as the strips are\n'
    printf '(tools/dev/gallery.sh); mask.pgm is `pel point threshold 120 in.ppm mask.pgm`,\n'
    printf 'speckled.pgm is `pel point adaptive 3 2 in.ppm speckled.pgm`.\n\n'
    printf '| place | operator | command |\n|---|---|---|\n%s' "$rows"
} > "$folder/operators.md"

# Between the markers in the README that lies two folders above the default one.
if [ -f "$folder/../../README.md" ]; then
    sed -e '/<!-- operators begin -->/,/<!-- operators end -->/{
        /<!-- operators begin -->/{p;r table.md
        }
        /<!-- operators end -->/!d
    }' "$folder/../../README.md" > README.md
    cp README.md "$folder/../../README.md"
fi
echo "$count pictures: $folder/operators/*.png, $folder/operators.md"
