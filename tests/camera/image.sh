# Sourced by run.sh: makes what the virtual machine boots. In $out/image, kept from run to run:
#     kernel          Debian's kernel, unpacked if it can be (that halves the time of booting)
#     system.cpio.gz  busybox, and the modules of the virtual cameras with all that they need
#     made-of         which packages they come from; another kernel package makes all of it anew
# and in $out, made by every run: programs.cpio.gz, the programs and scripts of the checks.

camera_modules='vivid vimc v4l2loopback'

# The kernel package that Debian recommends now, with its version; nothing if apt knows none.
find_kernel() {
    kernel=$(apt-cache depends linux-image-amd64 2>/dev/null |
        sed -n 's/^ *Depends: \(linux-image-[0-9].*\)$/\1/p' | head -n 1)
    [ "$kernel" ] || return 1
    release=${kernel#linux-image-}
    made_of="$kernel $(apt-cache show "$kernel" | sed -n 's/^Version: //p' | head -n 1)"
}

# download PACKAGE...: into the current folder. Old package lists name files that are gone by now.
download() {
    apt-get download -q "$@" ||
        { apt-get update -q && find_kernel && apt-get download -q "$@"; }
}

# unpack PACKAGE FOLDER [TAR-OPTION...]: what a downloaded package would install.
unpack() {
    package=$1
    folder=$2
    shift 2
    mkdir -p "$folder"
    dpkg-deb --fsys-tarfile "$package"_*.deb | tar x -C "$folder" "$@"
}

# A Debian kernel is one xz stream behind a loader; what follows the stream makes xz complain.
unpack_kernel() {
    magic=$(printf '\3757zXZ')
    start=$(LC_ALL=C grep -abo -F "$magic" "$1" | head -n 1 | cut -d : -f 1)
    if [ "$start" ]; then
        tail -c +$((start + 1)) "$1" | xz -dc 2>/dev/null >"$2" || true
        if [ "$(head -c 4 "$2" | tail -c 3)" = ELF ]; then
            return
        fi
    fi
    cp "$1" "$2"
}

# Modules that Debian's kernel leaves out, built with its headers. Nothing is installed: the
# packages are unpacked here, and the one path in them that assumes otherwise is corrected.
prepare_headers() {
    headers="linux-headers-$release"
    others=$(apt-cache depends "$headers" |
        sed -n 's/^ *Depends: \(linux-headers-.*-common\|linux-kbuild-.*\)$/\1/p')
    [ "$others" ] && download $headers $others || return 1
    for package in $headers $others; do
        unpack "$package" headers || return 1
    done
    tree=$PWD/headers/usr/src/$headers
    sed -i "s|^include /usr/src/|include $PWD/headers/usr/src/|" "$tree/Makefile"
}

# build_module NAME FOLDER [VARIABLE...]
build_module() {
    module=$1
    folder=$2
    shift 2
    make -s -C "$tree" M="$folder" "$@" modules || return 1
    mkdir -p "root/lib/modules/$release/extra"
    strip --strip-debug -o "root/lib/modules/$release/extra/$module.ko" "$folder/$module.ko"
}

build_loopback() {
    download v4l2loopback-dkms && unpack v4l2loopback-dkms loopback || return 1
    build_module v4l2loopback "$(echo "$PWD"/loopback/usr/src/v4l2loopback-*)"
}

build_vimc() {
    sources=linux-source-$(echo "$release" | cut -d . -f 1,2)
    inside=drivers/media/test-drivers/vimc
    download "$sources" || return 1
    mkdir -p vimc
    dpkg-deb --fsys-tarfile "$sources"_*.deb | tar xO "./usr/src/$sources.tar.xz" |
        xz -dc -T 0 | tar x -C vimc --wildcards "$sources/$inside/*" || return 1
    build_module vimc "$PWD/vimc/$sources/$inside" CONFIG_VIDEO_VIMC=m
}

# The tree of modules becomes one folder of them, with a list of what to load for each camera.
collect_modules() {
    depmod -b root "$release"
    mkdir -p system/modules
    for name in $camera_modules; do
        if modprobe -d root -S "$release" --show-depends "$name" >depends 2>/dev/null; then
            sed -n 's/^insmod //p' depends | while read -r file _; do
                cp "$file" system/modules/
                basename "$file"
            done >"system/modules/$name.list"
        else
            echo "not built: $name"
        fi
    done
    [ -s system/modules/vivid.list ]
}

make_system() {
    download "$kernel" && unpack "$kernel" root || return 1
    unpack_kernel "$(echo root/boot/vmlinuz-*)" kernel
    if prepare_headers; then
        build_loopback || echo 'v4l2loopback could not be built'
        build_vimc || echo 'vimc could not be built'
    fi
    collect_modules || return 1
    mkdir -p system/bin
    cp "$(command -v busybox)" system/bin/busybox
    pack system system.cpio.gz
    echo "$made_of" >made-of
}

# pack FOLDER ARCHIVE: as the kernel reads it.
pack() {
    (cd "$1" && find . | cpio -o -H newc -R 0:0 --quiet) | gzip -1 >"$2"
}

# Sees to it that $out/image is what it should be; needs the network only if it is not.
need_system() {
    image=$out/image
    if ! find_kernel; then
        [ -f "$image/made-of" ] || return 1
    elif [ "$(cat "$image/made-of" 2>/dev/null)" != "$made_of" ]; then
        rm -rf "$image"
        mkdir -p "$image/work"
        echo "Making the image from $made_of (log: $out/image.log)"
        (cd "$image/work" && make_system) >"$out/image.log" 2>&1 || return 1
        mv "$image/work/kernel" "$image/work/system.cpio.gz" "$image/work/made-of" "$image/"
        rm -rf "$image/work"
    fi
}

# add_program FILE: into the image, with the libraries that it is linked with.
add_program() {
    cp "$1" "$out/programs/bin/"
    ldd "$1" 2>/dev/null | grep -o '/[^ ]*' | while read -r library; do
        mkdir -p "$out/programs/$(dirname "$library")"
        cp -L "$library" "$out/programs/$library"
    done
}

# add_folder FOLDER: as it is, at the same place.
add_folder() {
    mkdir -p "$out/programs$1"
    cp -a "$1/." "$out/programs$1/"
}
