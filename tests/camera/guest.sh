# Runs in the virtual machine: all checks, one boot. Prints 'ok NAME: ...', 'FAIL NAME: ...' and
# 'SKIPPED NAME: ...' lines, '# ...' for whoever reads on, and last that it is through.

# load MODULE [PARAMETER...]: what it needs first; the parameters go to the last.
load() {
    name=$1
    shift
    if [ ! -s "/modules/$name.list" ]; then
        echo "SKIPPED $name: the module could not be built, see image.log"
        return 1
    fi
    while read -r file; do
        loaded=$(basename "$file" .ko | tr - _)
        if grep -q "^$loaded " /proc/modules; then
            continue
        elif [ "$loaded" = "$name" ]; then
            insmod "/modules/$file" "$@"
        else
            insmod "/modules/$file"
        fi
    done <"/modules/$name.list"
    if ! grep -q "^$name " /proc/modules; then
        echo "FAIL $name: the kernel does not take the module"
        return 1
    fi
}

# run SECONDS GROUP [ARGUMENT...]: one group of camera_check, which has to come to its end.
run() {
    limit=$1
    shift
    begun=$(date +%s)
    timeout "$limit" camera_check "$@" >"$1.out" 2>&1
    finish $? "$1" "$1.out"
    echo "# $1 took $(($(date +%s) - begun)) s"
}

# finish STATUS GROUP FILE: what a group said, without a closing line of its own, and whether it
# came to its end.
finish() {
    grep -vE '^[0-9]+ passed, [0-9]+ failed' "$3"
    if [ "$1" -gt 1 ]; then
        echo "FAIL $2 ends: status $1"
    elif ! grep -qE '^(ok|FAIL|SKIPPED) ' "$3"; then
        echo "FAIL $2 says something: it checked nothing"
    fi
}

# Three webcams, video0 to 2, and a picture of any size, video3, beside a screen, video4.
check_vivid() {
    load vivid n_devs=4 node_types=0x1,0x1,0x1,0x101 num_inputs=1,1,1,1 num_outputs=1,1,1,1 \
        input_types=0,0,0,2 || return
    # These take 18 seconds of waiting: beside the others.
    timeout 60 camera_check clock /dev/video1 '64 Bit' >clock64.out 2>&1 &
    clock64=$!
    timeout 60 camera_check clock /dev/video2 '32 Bit' >clock32.out 2>&1 &
    clock32=$!
    run 60 list 4
    run 30 kinds /dev/video4
    run 30 access /dev/video0
    run 30 changed /dev/video0
    run 90 pictures /dev/video0
    run 60 ranges /dev/video0
    run 60 sizes /dev/video3
    run 30 controls /dev/video0
    run 30 busy /dev/video0
    run 30 setup-errors /dev/video0
    run 30 stream-errors /dev/video0
    run 30 dropped /dev/video0
    run 30 wrap /dev/video0
    run 30 stale /dev/video0
    run 30 signals /dev/video0
    wait $clock64
    finish $? clock clock64.out
    wait $clock32
    finish $? clock clock32.out
    check_commands
    run 30 unplugged /dev/video0
    run 40 removed /dev/video0 /dev/video0
    run 40 removed /dev/video0 platform:vivid-000
    rmmod vivid
}

# same_blobs NAME SEED CSV: the rows of the first frame are those of the scene's file.
same_blobs() {
    awk -F , 'NR == 1 || $1 == 0' "$3" >first.csv
    if cmp -s first.csv "/checks/$2.csv"; then
        echo "ok $1 gives the blobs of the file: $(wc -l <first.csv) lines"
    else
        echo "FAIL $1 gives the blobs of the file: $(diff first.csv "/checks/$2.csv" | head -n 3)"
    fi
}

# play FILE RATE: the frames of the file are what video20 shows, until `stop_playing`.
play() {
    camera_check feed /dev/video20 "$1" 320 240 "$2" >feed.out 2>&1 &
    player=$!
    sleep 1
}

stop_playing() {
    kill $player
    wait $player
    finish $? feed feed.out
}

# expect NAME COMMAND...: the command succeeds.
expect() {
    what=$1
    shift
    if "$@" >expect.out 2>&1; then
        echo "ok $what: $*"
    else
        echo "FAIL $what: $*: status $?, $(head -n 3 expect.out)"
    fi
}

has_capture() {
    pel capture --help >/dev/null 2>&1
}

# whole_frames FILE BYTES: whether a YUV4MPEG2 file has more than three frames of so many bytes, the
# last of them complete.
whole_frames() {
    one=$(($2 + 6))
    all=$(($(stat -c %s "$1") - $(head -n 1 "$1" | wc -c)))
    [ $((all / one)) -gt 3 ] && [ $((all % one)) -eq 0 ]
}

# The commands and vivid, whose settings they show and change.
check_commands() {
    has_capture || return
    umask 022
    expect 'pel cameras' pel cameras
    cp expect.out cameras.txt
    for word in /dev/video0 platform:vivid-000 YUYV 320x180 Brightness; do
        expect "pel cameras: $word" grep -q -i -e "$word" cameras.txt
    done
    expect 'pel capture pictures' \
        pel capture -d /dev/video0 --size 320x180 --gain 77 --count 3 'p-%04d.ppm'
    expect 'pel capture, three of them' test "$(ls p-*.ppm | tr '\n' ' ')" = \
        'p-0000.ppm p-0001.ppm p-0002.ppm '
    expect 'pel capture, mode' test "$(stat -c %a p-0000.ppm)" = 644
    expect 'pel capture, size' grep -q '^320 180$' p-0000.ppm
    expect 'pel capture, settings in the comment' grep -q -i 'gain.*77' p-0000.ppm
    expect 'pel capture overwrites nothing' sh -c \
        '! pel capture -d /dev/video0 --count 1 p-0000.ppm'
    expect 'pel capture overwrites by force' \
        pel capture -d /dev/video0 --count 1 --force p-0000.ppm
    timeout -s INT 4 pel capture -d /dev/video0 --size 320x180 until.y4m 2>until.log
    expect 'pel capture until Ctrl-C' whole_frames until.y4m $((320 * 180 * 2))
}

# The scene as the command sees it: live, and from what it captured.
check_blobs() {
    if ! has_capture; then
        echo 'SKIPPED commands: this pel has no command capture'
        return
    fi
    classes=/checks/scene.classes
    play /checks/7.yuv 10
    timeout 60 pel blobs -d /dev/video20 -c $classes --csv --count 2 >live.csv 2>live.log
    same_blobs 'pel blobs -d' 7 live.csv
    timeout 60 pel capture -d /dev/video20 --count 2 two.y4m 2>capture.log
    pel blobs -c $classes --csv two.y4m >file.csv 2>>capture.log
    same_blobs 'pel capture to a file' 7 file.csv
    timeout 60 pel capture -d /dev/video20 --count 2 - 2>>capture.log |
        pel blobs -c $classes --csv - >pipe.csv 2>>capture.log
    same_blobs 'pel capture to a pipe' 7 pipe.csv
    sed 's/^/# /' live.log capture.log
    stop_playing
}

# Scenes of our own, through the kernel.
check_loopback() {
    load v4l2loopback devices=1 exclusive_caps=1 video_nr=20 card_label=scene || return
    cat /checks/7.yuv /checks/8.yuv /checks/9.yuv >all.yuv
    play all.yuv 10
    run 30 fed /dev/video20 all.yuv
    stop_playing
    run 30 stalled /dev/video20 /checks/7.yuv
    check_blobs
    rmmod v4l2loopback
}

# A camera that only libcamera puts together. It asks udev, which is not here, and takes an empty
# record of a device for one that udev has looked at.
check_vimc() {
    load vimc || return
    mkdir -p /run/udev/data
    for device in /sys/class/video4linux/* /sys/bus/media/devices/*; do
        : >"/run/udev/data/c$(cat "$device/dev")"
    done
    export LIBCAMERA_LOG_LEVELS='*:ERROR'
    for group in vimc unplug; do
        timeout 90 libcamera_check $group >libcamera.out 2>&1
        status=$?
        if grep -q '^this build is without libcamera$' libcamera.out; then
            echo 'SKIPPED libcamera: the port was built without it'
            return
        fi
        finish $status "libcamera $group" libcamera.out
    done
}

check_vivid
check_loopback
check_vimc
echo 'the checks are through'
