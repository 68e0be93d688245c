# Set-up that scripts/reckon, scripts/test and scripts/check share: Debian packages, configure, build.
# Sourced. Its output goes to stderr, and there is none when there is nothing to do.
set -euo pipefail
root="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd -P)"

say() { printf 'reckon: %s\n' "$*" >&2; }
die() { say "$*"; exit 3; }

# with_lock COMMAND...: one set-up at a time in this folder. The command runs in a subshell.
with_lock() {
  mkdir -p "$root/build" 2>/dev/null && [[ -w $root/build ]] || die "cannot write to $root/build"
  (
    flock --nonblock 9 || { say "waiting for another set-up of this folder"; flock 9; }
    "$@"
  ) 9>"$root/build/.lock"
}

# A home that can't be written to (a system account's) must not stop ccache and the wheel's cache.
writable_caches() {
  mkdir -p "${XDG_CACHE_HOME:-${HOME:-/nonexistent}/.cache}/reckon" 2>/dev/null && return
  export XDG_CACHE_HOME="$root/build/cache"
  export CCACHE_DIR="${CCACHE_DIR:-$XDG_CACHE_HOME/ccache}"
}

quietly() {  # COMMAND...: shows its output only if it fails
  local output
  output="$("$@" 2>&1)" || { printf '%s\n' "$output" >&2; return 1; }
}

missing_packages() {  # GROUP...
  local wanted
  wanted="$(awk -v groups=" $* " '{ sub(/#.*/, "") }
    /^\[/ { gsub(/[][]/, "", $1); wanted = index(groups, " " $1 " "); next }
    wanted && NF { print $1 }' "$root/scripts/packages.debian")"
  # shellcheck disable=SC2086
  comm -23 <(sort <<<"$wanted") <(dpkg-query -W -f '${db:Status-Status} ${Package}\n' $wanted \
    2>/dev/null | sed -n 's/^installed //p' | sort)
}

install_packages() {  # GROUP...
  local missing as_root=()
  command -v dpkg-query >/dev/null || return 0  # another system: CMake names what it lacks
  missing="$(missing_packages "$@" | tr '\n' ' ')"
  [[ -n $missing ]] || return 0
  if ((EUID != 0)); then
    command -v sudo >/dev/null && as_root=(sudo)
    [[ -t 0 ]] || as_root+=(${as_root:+--non-interactive})
    ((${#as_root[@]})) && "${as_root[@]}" true || die "Debian packages are missing, and only root" \
      "can install them: apt-get install ${missing% }"
  fi
  say "installing Debian packages: ${missing% }"
  as_root+=(env DEBIAN_FRONTEND=noninteractive apt-get --quiet --assume-yes
    --option Acquire::Retries=3 --option DPkg::Lock::Timeout=600)
  quietly "${as_root[@]}" update || say "apt-get update failed; trying with the lists that are here"
  # shellcheck disable=SC2086
  quietly "${as_root[@]}" install --no-install-recommends $missing ||
    die "apt-get could not install: ${missing% }"
}

configure() {  # PRESET
  local ninja="$root/build/$1/build.ninja"
  [[ -e $ninja && ! $root/CMakePresets.json -nt $ninja ]] && return
  say "configuring the $1 build"
  (cd "$root" && quietly cmake --preset "$1") || die "the $1 build could not be configured"
}

# Ninja's output in, a progress line out: at most ten lines, or one that moves on a terminal. What
# compilers say passes through.
progress() {  # PRESET
  local line tenth shown=-1 newline=''
  while IFS= read -r line; do
    if [[ $line =~ ^\[([0-9]+)/([0-9]+)\] ]]; then
      ((BASH_REMATCH[2] >= 10)) || continue  # not worth a line
      tenth=$((10 * BASH_REMATCH[1] / BASH_REMATCH[2]))
      if [[ -t 2 ]]; then
        printf '\r\033[Kreckon: building %s %s' "$1" "${BASH_REMATCH[0]}" >&2
        newline=$'\n'
      elif ((tenth > shown)); then
        shown=$tenth
        say "building $1 ${BASH_REMATCH[0]}"
      fi
    elif [[ $line != '-- '* && $line != 'ninja: no work to do.' && $line != 'ninja: Entering'* ]]; then
      printf '%s%s\n' "$newline" "$line" >&2
      newline=''
    fi
  done
  printf '%s' "$newline" >&2
}

build() {  # PRESET TARGET...
  configure "$1"
  ninja -C "$root/build/$1" "${@:2}" 2>&1 | progress "$1" || die "the $1 build failed"
}

# The tests run evo as a program out of a virtual environment of their own; without it they skip.
test_environment() {
  local venv="$root/build/venv" wanted="$root/tests/requirements.txt" python=/usr/bin/python3
  cmp --silent "$wanted" "$venv/installed.txt" && return
  say "installing the test-only Python packages of tests/requirements.txt"
  rm -rf "$venv"
  [[ -x $python ]] || python=python3
  if quietly "$python" -m venv "$venv" &&
    quietly "$venv/bin/python3" -m pip install --quiet --requirement "$wanted"; then
    cp "$wanted" "$venv/installed.txt"
  else
    rm -rf "$venv"
    say "pip could not install them: the tests that run evo are skipped"
  fi
}
