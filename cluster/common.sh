# Sourced by the scripts of this folder: the program, a run by one process to compare with, and the kill half way.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

MEMBERS="${MEMBERS:-1000}"
# So small that half a sweep can be seen on a fast machine, and parts so small that there is something to go on from.
OPTIONS=(--members "$MEMBERS" --step 0.002)
RUN=(--batch 8 --threads 1)
SHARDS=8

WORK="$(mktemp -d)"
cleanup=()
trap 'for step in "${cleanup[@]}"; do $step || true; done; rm -rf "$WORK"' EXIT

# Installs Debian packages that are not there.
debian() {
    local missing=()
    for package in "$@"; do
        dpkg -s "$package" >/dev/null 2>&1 || missing+=("$package")
    done
    if [ "${#missing[@]}" -gt 0 ]; then
        apt-get update -qq
        DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "${missing[@]}" >/dev/null
    fi
}

# PROGRAM skips the build, such as for a site that has the program already.
if [ -z "${PROGRAM:-}" ]; then
    cargo build --locked --quiet --release -p eem-studies --features arrow --bin sweep
    PROGRAM="${CARGO_TARGET_DIR:-target}/release/sweep"
fi
PROGRAM="$(realpath "$PROGRAM")"

sweep() {
    "$PROGRAM" "${OPTIONS[@]}" "$@"
}

# How many members of a directory have been reported; the exit code of `status` says whether that is all.
reported() {
    { sweep status --dir "$1" 2>/dev/null || true; } | sed -n '1s/ of .*//p'
}

# The processes that are at work, from the progress that they tell.
processes() {
    sed -n 's/.*"process":\([0-9]*\).*/\1/p' "$1"/progress/*.json 2>/dev/null
}

# Waits until half of the members are there, then kills a process that is at work.
kill_half_way() {
    local directory="$1" now process
    for _ in $(seq 1200); do
        now="$(reported "$directory")"
        now="${now:-0}"
        [ "$now" -lt "$MEMBERS" ] || break
        for process in $(processes "$directory"); do
            [ "$now" -ge $((MEMBERS / 2)) ] || break
            # Only processes of this program; a number may belong to another by now.
            if [ "$(readlink "/proc/$process/exe" 2>/dev/null)" = "$PROGRAM" ] && kill -9 "$process" 2>/dev/null; then
                echo "killed process $process with $now members reported"
                return
            fi
        done
        sleep 0.05
    done
    echo "there was nobody left to kill, take more MEMBERS" >&2
    return 1
}

# Merges, and compares with the table of one process.
compare() {
    local directory="$1"
    sweep status --dir "$directory" | head -1
    sweep merge --dir "$directory"
    if [ ! -e "$WORK/one/merged.csv" ]; then
        sweep run --dir "$WORK/one" --threads 1 >/dev/null
        sweep merge --dir "$WORK/one" >/dev/null
    fi
    cmp "$directory/merged.csv" "$WORK/one/merged.csv"
    echo "$2: the bits of one process"
}
