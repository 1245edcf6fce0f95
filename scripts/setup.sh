# Sourced by the scripts beside it: the packages that are missing, and the Release build in build/.
# shellcheck shell=bash

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)

# fail MESSAGE: one line on stderr, exit code 1.
fail() {
  printf '%s: %s\n' "$(basename "$0")" "$*" >&2
  exit 1
}

# missing_packages GROUP...: the packages of these groups that are not installed, one a line.
missing_packages() {
  local group package status
  while read -r group package _; do
    [[ " $* " == *" $group "* ]] || continue
    status=$(dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null) || true
    [ "$status" = installed ] || echo "$package"
  done <"$root/scripts/packages.txt"
}

# install_packages GROUP...: installs what is missing and nothing else; where nothing is, apt-get is not touched.
install_packages() {
  command -v apt-get >/dev/null && command -v dpkg-query >/dev/null ||
    fail "no apt-get here: install what scripts/packages.txt names, then cmake --preset release && cmake --build build"
  local missing as_root=()
  mapfile -t missing < <(missing_packages "$@")
  [ ${#missing[@]} -gt 0 ] || return 0
  if [ "$(id -u)" -ne 0 ]; then
    command -v sudo >/dev/null || fail "packages are missing (${missing[*]}): run this as root, or install sudo or them"
    as_root=(sudo)
  fi
  echo "Installing ${missing[*]}"
  local apt=(env DEBIAN_FRONTEND=noninteractive apt-get -q -y -o DPkg::Lock::Timeout=300)
  "${as_root[@]}" "${apt[@]}" update || fail "apt-get update failed: see the lines above"
  "${as_root[@]}" "${apt[@]}" install --no-install-recommends "${missing[@]}" ||
    fail "apt-get could not install ${missing[*]}: see the lines above"
}

# build TARGET [CMAKE_OPTION...]: configures (quietly; errors show) and builds the Release preset in build/.
build() {
  local target=$1
  shift
  (cd "$root" && cmake --preset release -DFOLK_FOLDERS_AS_ONE=ON "$@" >/dev/null && cmake --build --preset release --target "$target")
}
