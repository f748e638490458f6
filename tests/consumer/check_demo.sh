#!/bin/sh
# The demo does what the README says:  check_demo.sh SOURCE_DIR OUT_DIR
set -u

source_dir=$1
out=$2
passed=0
failed=0

check() {
    what=$1
    shift
    if "$@" >/dev/null 2>&1; then
        passed=$((passed + 1))
    else
        failed=$((failed + 1))
        echo "wrong: $what"
    fi
}

rm -rf "$out/demo-out"
mkdir -p "$out"
cd "$out" || exit 1 # the demo is called from anywhere
mkdir -p "$out/bin"
rm -f "$out/cmake-words.txt"
printf '#!/bin/sh\necho "$*" >>"%s"\nexec "%s" "$@"\n' "$out/cmake-words.txt" \
    "$(command -v cmake)" >"$out/bin/cmake"
chmod +x "$out/bin/cmake"
PATH=$out/bin:$PATH sh "$source_dir/tools/demo.sh" "$out" >"$out/demo.txt" 2>&1
check "the demo's exit status" test $? -eq 0
cat "$out/demo.txt"
# A number is given: without one, make starts everything at once, which small machines do not bear.
check "the demo says how many jobs" grep -q -- '--parallel [0-9]' "$out/cmake-words.txt"

# Columns of the table that hold a class of the demo's class file.
classes=$(sed -n 's/^(.*) *[0-9.]* *[0-9]* *\([a-z_]*\) *$/\1/p' \
    "$source_dir/tools/demo/robot.classes")
check "the demo's class file has classes" test -n "$classes"
for class in $classes; do
    check "the table has a blob of class $class" grep -qw "$class" "$out/demo.txt"
done
for file in robot.ppm robot.png; do
    check "the demo names $file" grep -q "demo-out/$file\$" "$out/demo.txt"
    check "the demo wrote $file" test -s "$out/demo-out/$file"
done

# The picture of the README is what the demo makes, pixel by pixel.
pel=$out/demo/tools/pel
check "annotated.png is readable" "$pel" convert "$source_dir/tools/demo/annotated.png" \
    "$out/readme.ppm"
check "robot.png is readable" "$pel" convert "$out/demo-out/robot.png" "$out/made.ppm"
# (If the drawing was changed on purpose: copy demo-out/robot.png to tools/demo/annotated.png.)
check "the README's picture is what the demo makes" cmp "$out/readme.ppm" "$out/made.ppm"

echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ]
