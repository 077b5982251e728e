# SPDX-License-Identifier: MIT
# Sourced by tools/run and tools/test: from a fresh Debian 12 to a configured and built tree.

packages=(g++ cmake ninja-build libeigen3-dev libboost-dev libcgal-dev libgmp-dev libmpfr-dev
          libcli11-dev nlohmann-json3-dev libgtest-dev libgmock-dev libtbb-dev libsqlite3-dev libopenmpi-dev openmpi-bin
          libccd-dev libfcl-dev libbullet-dev libode-dev)
mesh_package=libcgal-demo
# What tools/fuzzers compiles with.
fuzzer_packages=(clang libclang-rt-14-dev)
# What draws the figures of `touchstone bench`.
plot_packages=(python3-matplotlib)
# Meshes of more bytes take longer to read than they are worth.
max_mesh_size=1500k

say() { printf 'touchstone: %s\n' "$*" >&2; }

die() {
  say "$*"
  exit 2
}

is_installed() {
  [ "$(dpkg-query -W -f '${db:Status-Status}' "$1" 2>/dev/null)" = installed ]
}

as_root() {
  if [ "$(id -u)" = 0 ]; then
    "$@"
  elif command -v sudo >/dev/null; then
    sudo "$@"
  else
    die "needs root or sudo to install packages: $*"
  fi
}

# Runs a command; what it prints appears only when it fails.
quietly() {
  local log
  log=$(mktemp)
  if ! "$@" >"$log" 2>&1; then
    tail -n 60 "$log" >&2
    rm -f "$log"
    die "failed: $*"
  fi
  rm -f "$log"
}

update_package_lists() {
  [ -n "${package_lists_updated:-}" ] && return
  quietly as_root apt-get update
  package_lists_updated=yes
}

# Installs those of the named packages that are missing.
install_missing() {
  local missing=() package
  for package in "$@"; do
    is_installed "$package" || missing+=("$package")
  done
  [ ${#missing[@]} = 0 ] && return
  command -v apt-get >/dev/null || die "needs these Debian packages: ${missing[*]}"
  say "installing ${missing[*]}"
  update_package_lists
  quietly as_root env DEBIAN_FRONTEND=noninteractive \
    apt-get install -y --no-install-recommends "${missing[@]}"
}

# As many jobs as there are processors and 2 GiB of free memory for each: CGAL is heavy to compile.
job_count() {
  local cpus memory
  cpus=$(nproc)
  memory=$(awk '/MemAvailable/ { print int($2 / 2097152) }' /proc/meminfo)
  [ "$memory" -lt 1 ] && memory=1
  [ "$memory" -lt "$cpus" ] && echo "$memory" || echo "$cpus"
}

# configure_preset NAME [cmake arguments...]: into build/NAME, unless it is there already.
configure_preset() {
  local preset=$1
  shift
  [ -f "$root/build/$preset/build.ninja" ] && return
  local launcher=()
  command -v ccache >/dev/null && launcher=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache)
  say "configuring build/$preset"
  (cd "$root" && quietly cmake --preset "$preset" "${launcher[@]}" "$@")
}

# build_preset NAME [targets...]
build_preset() {
  local preset=$1
  shift
  local targets=()
  [ $# -gt 0 ] && targets=(--target "$@")
  # Nothing is said when there is nothing to do.
  if ! ninja -C "$root/build/$preset" -n "$@" 2>/dev/null | grep -q 'no work to do'; then
    say "building build/$preset"
  fi
  quietly cmake --build "$root/build/$preset" -j "$(job_count)" "${targets[@]}"
}

# The archive of real meshes that Debian ships: from the installed package or, where the system drops
# documentation folders, from the package file itself.
find_mesh_archive() {
  local archive=/usr/share/doc/libcgal-dev/data.tar.gz
  if [ ! -f "$archive" ]; then
    archive=$(dpkg-query -L "$mesh_package" 2>/dev/null | grep '/data\.tar\.gz$' || true)
  fi
  if [ ! -f "${archive:-/nonexistent}" ]; then
    update_package_lists
    (cd "$1" && quietly apt-get download "$mesh_package" && quietly dpkg-deb -x ./*.deb .)
    archive=$(find "$1" -name data.tar.gz | head -n 1)
  fi
  [ -f "$archive" ] || die "$mesh_package holds no data.tar.gz"
  echo "$archive"
}

# Unpacks the meshes into build/meshes, once.
unpack_meshes() {
  local meshes=$root/build/meshes work
  [ -f "$meshes/.complete" ] && return
  install_missing "$mesh_package"
  say "unpacking meshes of $mesh_package into build/meshes"
  mkdir -p "$meshes"
  work=$(mktemp -d)
  local archive
  archive=$(find_mesh_archive "$work") || exit 2
  tar -xzf "$archive" -C "$work" --wildcards '*/meshes/*'
  find "$work" -path '*/meshes/*' -type f -size "-$max_mesh_size" \
    \( -name '*.off' -o -name '*.obj' -o -name '*.stl' -o -name '*.ply' \) -exec cp -t "$meshes" {} +
  rm -rf "$work"
  touch "$meshes/.complete"
}
