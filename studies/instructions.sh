#!/usr/bin/env bash
# Instructions per step of the hot cases, and per iteration of the satellite. Needs valgrind (package `valgrind`).
# Each case is run with N and with 2N steps; the difference is free of what starting takes. Prints
# `case instructions` per line, to the file OUT if there is one: studies/instructions.sh [OUT]
set -euo pipefail
cd "$(dirname "$0")/.."

command -v valgrind >/dev/null || { echo "valgrind is not installed" >&2; exit 1; }
cargo build --quiet --locked --release -p eem-studies --bin hot_cases
program="${CARGO_TARGET_DIR:-target}/release/hot_cases"

# Instructions and the numbers that the program prints, of a case with so many steps.
count() {
    local log printed
    log=$(mktemp)
    printed=$(valgrind --tool=callgrind --callgrind-out-file=/dev/null "$program" "$1" "$2" 2>"$log") \
        || { cat "$log" >&2; exit 1; }
    echo "$(sed -n 's/.*Collected : //p' "$log") $printed"
    rm "$log"
}

# case, N, and what is divided by: the field 2 (steps) or 3 (iterations)
while read -r name steps field; do
    once=$(count "$name" "$steps")
    twice=$(count "$name" $((2 * steps)))
    echo "$once $twice" | awk -v name="$name" -v field="$field" \
        '{ printf "%-20s %.0f\n", name, ($4 - $1) / ($(3 + field) - $field) }'
done <<CASES | tee ${1:+"$1"}
explicit-single 100 2
explicit-krueger 100 2
explicit-log 100 2
explicit-elastic 100 2
explicit-chain 100 2
temperature-single 100 2
temperature-log 100 2
entropy-single 100 2
entropy-log 100 2
satellite 3 3
CASES
