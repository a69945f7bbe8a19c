# Shared by ./run, ./test and .ci/run: installs missing Debian packages, configures and builds.
# Everything here writes to stderr, so that stdout belongs to the program.

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)

build_packages="g++ cmake ninja-build pkg-config glslc libvulkan-dev libvulkan-volk-dev
    mesa-vulkan-drivers libglm-dev libopenexr-dev libpng-dev libzstd-dev libstb-dev libopenblas-pthread-dev
    libtbb-dev libembree-dev libcli11-dev libfmt-dev libspdlog-dev nlohmann-json3-dev zlib1g-dev
    libmeshoptimizer-dev libdraco-dev libwebp-dev libglfw3-dev libimgui-dev
    libgl1-mesa-dri"
test_packages="$build_packages vulkan-validationlayers libgtest-dev xvfb xdotool libopenmpi-dev openmpi-bin
    python3-dev python3-numpy python3-pip python3-pybind11 python3-setuptools python3-wheel mypy"
fuzz_packages="clang libclang-rt-dev"
ci_packages="$test_packages clang-format clang-tidy"

# What proves each package where there is no dpkg to ask: a command or a header, or one of several.
package_commands="g++:g++ cmake:cmake ninja-build:ninja pkg-config:pkg-config glslc:glslc
    xvfb:Xvfb xdotool:xdotool openmpi-bin:mpirun clang:clang++ clang-format:clang-format clang-tidy:clang-tidy"
package_headers="libvulkan-dev:vulkan/vulkan.h libvulkan-volk-dev:volk.h libglm-dev:glm/glm.hpp
    libopenexr-dev:OpenEXR/ImfHeader.h libpng-dev:png.h libzstd-dev:zstd.h libstb-dev:stb/stb_image.h
    libopenblas-pthread-dev:cblas.h libtbb-dev:tbb/parallel_for.h libembree-dev:embree4/rtcore.h,embree3/rtcore.h
    libcli11-dev:CLI/CLI.hpp libfmt-dev:fmt/core.h libspdlog-dev:spdlog/spdlog.h
    nlohmann-json3-dev:nlohmann/json.hpp zlib1g-dev:zlib.h
    libmeshoptimizer-dev:meshoptimizer.h libdraco-dev:draco/compression/mesh/mesh_sequential_decoder.h
    libwebp-dev:webp/decode.h libglfw3-dev:GLFW/glfw3.h
    libimgui-dev:imgui/imgui.h libgtest-dev:gtest/gtest.h libopenmpi-dev:mpi.h python3-dev:Python.h"

say() { echo "lumel: $*" >&2; }
die() { say "$*"; exit 1; }

# progress <text>: what is going on, for a person at a terminal.
progress() { if [[ -t 2 ]]; then say "$*"; fi; }

# quietly <log> <what> <command …>: shows the command's output only if it fails.
quietly() {
    local log=$1 what=$2
    shift 2
    if ! "$@" >"$log" 2>&1 </dev/null; then
        tail -n 60 "$log" >&2
        say "$what failed; the whole output is in $log."
        return 1
    fi
}

missing_by_dpkg() {
    local installed
    installed=$(dpkg-query -W -f='${db:Status-Status} ${Package}\n' "$@" 2>/dev/null || true)
    for package in "$@"; do
        [[ $'\n'$installed$'\n' == *$'\ninstalled '"$package"$'\n'* ]] || echo "$package"
    done
}

missing_by_probe() {
    local pair headers source=""
    for pair in $package_commands; do
        [[ " $* " == *" ${pair%%:*} "* ]] || continue
        command -v "${pair#*:}" >/dev/null || echo "${pair%%:*}"
    done
    [[ " $* " != *" mesa-vulkan-drivers "* ]] || compgen -G "/*/*/vulkan/icd.d/*.json" >/dev/null ||
        compgen -G "/etc/vulkan/icd.d/*.json" >/dev/null || echo mesa-vulkan-drivers
    [[ " $* " != *" vulkan-validationlayers "* ]] ||
        compgen -G "/usr/share/vulkan/explicit_layer.d/*validation*.json" >/dev/null ||
        echo vulkan-validationlayers
    command -v g++ >/dev/null || return 0
    for pair in $package_headers; do
        # Without Python's packages or MPI their tests skip; mpi.h is not where compilers look.
        [[ " $* " == *" ${pair%%:*} "* && $pair != python3-* && $pair != libopenmpi-* ]] || continue
        headers=${pair#*:}
        source+="#if !(__has_include(<${headers//,/>) || __has_include(<}>))"$'\n'"${pair%%:*}"$'\n'"#endif"$'\n'
    done
    g++ -x c++ -E -P - <<<"$source"
}

# unfit <package …>: prints a line for each package that apt lacks or whose version CMakeLists.txt refuses.
unfit() {
    local package name least below version
    local -A offered=()
    while read -r package version; do
        offered[$package]=${version#*:}
    done < <(LC_ALL=C apt-cache policy "$@" | awk '/^[^ ]/ { package = substr($1, 1, length($1) - 1) }
        $1 == "Candidate:" && $2 != "(none)" { print package, $2 }')
    for package in "$@"; do
        [[ -n ${offered[$package]:-} ]] || echo "there is no package $package"
    done
    while read -r package name least below; do
        version=${offered[$package]:-}
        [[ -n $version && -n $least ]] || continue
        if dpkg --compare-versions "$version" lt "$least" ||
            { [[ -n $below ]] && dpkg --compare-versions "$version" ge "$below"; }; then
            echo "$package is $version, and Lumel needs $least or newer${below:+, below $below}"
        fi
    done < <(sed -nE -e 's/^cmake_minimum_required\(VERSION (.*)\)/cmake CMake \1/p' \
        -e 's/^lumel_find\((.*)\)/\1/p' "$root/CMakeLists.txt")
}

# need_packages <package …>: returns with all of them present, or does not return.
need_packages() {
    local missing as_root=""
    if ! command -v apt-get >/dev/null || ! command -v dpkg-query >/dev/null; then
        missing=$(missing_by_probe "$@" | xargs)
        [[ -z $missing ]] || die "there is no apt here; please install what these Debian packages" \
            "hold: $missing"
        return 0
    fi
    missing=$(missing_by_dpkg "$@" | xargs)
    [[ -n $missing ]] || return 0
    if [[ $(id -u) != 0 ]]; then
        command -v sudo >/dev/null || die "please install (neither root nor sudo): $missing"
        as_root=sudo
    fi
    progress "installing $missing"
    local log=$root/build/apt.log environment="env DEBIAN_FRONTEND=noninteractive"
    local update="$as_root $environment apt-get -qq update"
    local install="$as_root $environment apt-get -qq -y --no-install-recommends install $missing" unfit
    # The package lists may be absent or too old to match the mirror: then fetch them and retry.
    if [[ -n $(unfit "$@") ]]; then
        quietly "$log" "apt-get update" $update || exit 1
        unfit=$(unfit "$@")
        [[ -z $unfit ]] || die "the packages of this release do not fit: ${unfit//$'\n'/; }."
    fi
    if ! $install >"$log" 2>&1 </dev/null; then
        quietly "$log" "apt-get update" $update || exit 1
        quietly "$log" "installing $missing" $install || exit 1
    fi
}

# A build folder keeps what it was configured with in its file `configured`: the path that it was made for,
# and below it the options.

# kept_options <preset> <options> [<others>]: the folder's own options if they hold these, else these or
# the others.
kept_options() {
    local kept
    kept=$(tail -n 1 "$root/build/$1/configured" 2>/dev/null) && [[ $kept == *"$2"* ]] || kept=${3:-$2}
    echo "$kept"
}

# need_configured <preset> <cmake options>
need_configured() {
    local preset=$1 options=$2 folder=$root/build/$1 fresh="" wanted=$root$'\n'$2
    [[ ! -f $folder/build.ninja || $root/CMakePresets.json -nt $folder/configured ||
        $(<"$folder/configured") != "$wanted" ]] || return 0
    progress "configuring"
    mkdir -p "$folder"
    # The cache is discarded after a move, and when the presets changed: they may name another compiler.
    [[ ! -f $folder/configured || ($(head -n 1 "$folder/configured") == "$root" &&
        $folder/configured -nt $root/CMakePresets.json) ]] || fresh=--fresh
    cd "$root"
    quietly "$folder/configure.log" "configuring" cmake $fresh --preset "$preset" $options || exit 1
    cd "$OLDPWD"
    echo "$wanted" >"$folder/configured"
}

# need_build <preset> <cmake options> <target …>: configures where needed, builds what changed.
need_build() {
    local preset=$1 folder=$root/build/$1
    need_configured "$1" "$2"
    shift 2
    # At a terminal ninja's own status line shows how far it is, if there is anything to do.
    if [[ -t 2 ]] && ninja -C "$folder" -n "$@" 2>/dev/null | grep -q '^\['; then
        cmake --build "$folder" --target "$@" >&2 </dev/null || die "building failed."
    else
        quietly "$folder/build.log" "building" ninja -C "$folder" "$@" || exit 1
    fi
}

# one_at_a_time: holds a lock until release, so that two runs do not build in one folder.
one_at_a_time() {
    mkdir -p "$root/build"
    if command -v flock >/dev/null; then
        exec 9>"$root/build/lock"
        flock 9
    fi
}
release() { exec 9>&-; }
