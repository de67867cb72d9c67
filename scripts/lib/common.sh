# Shared by the scripts: where things are, messages, packages.
# shellcheck shell=bash disable=SC2034
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
build=${GPUDEM_BUILD_DIR:-$root/build}
deps=$root/build/deps

say() { printf 'gpudem: %s\n' "$*" >&2; }
die() {
  say "$*"
  exit 1
}

as_root() {
  if [ "$(id -u)" = 0 ]; then
    "$@"
  elif command -v sudo >/dev/null; then
    sudo "$@"
  else
    die "'$*' needs root: ask your administrator for it, or see doc/Howto_install.md for an installation without root"
  fi
}

cores() { nproc 2>/dev/null || echo 1; }

# The first python3 with the modules named: that of conda or pyenv is often first in PATH and has none of them.
python_with() {
  local python modules=$*
  while read -r python; do
    if "$python" -c "import ${modules// /, }" 2>/dev/null; then
      printf '%s\n' "$python"
      return
    fi
  done < <(type -ap python3; echo /usr/bin/python3)
  die "no python3 in PATH has: $modules (Debian: python3-${modules// / python3-}; or pip install $modules)"
}
