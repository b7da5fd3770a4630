#!/usr/bin/env bash
# Instructions per step of the hot cases, and per iteration of the satellite. Needs valgrind (package `valgrind`).
# Each case is run with N and with 2N steps; the difference is free of what starting takes.
#
#   studies/instructions.sh [OUT]      prints `case instructions` per line, to the file OUT if there is one
#   studies/instructions.sh --check    without the satellite; fails if a number differs by more than 2 % from the one in
#                                      studies/instructions.txt, which is for one compiler
set -euo pipefail
cd "$(dirname "$0")/.."

expected=studies/instructions.txt
features=solid
if [ "${1:-}" = --check ]; then
    features=
    compiler=$(sed -n 's/^# compiler: //p' "$expected")
    present="$(rustc --version | cut -d ' ' -f 2) $(rustc -vV | sed -n 's/^host: //p')"
    for reason in \
        "$(command -v valgrind >/dev/null || echo 'valgrind is not installed')" \
        "$([ "$compiler" = "$present" ] || echo "the numbers are for rustc $compiler, this is $present")"; do
        if [ -n "$reason" ]; then
            echo "NOT CHECKED: instructions per step, because $reason"
            exit 0
        fi
    done
fi
command -v valgrind >/dev/null || { echo "valgrind is not installed" >&2; exit 1; }
cargo build --quiet --locked --release -p eem-hot-cases --features "$features"
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
cases() {
    cat <<CASES
explicit-single 100 2
explicit-krueger 100 2
explicit-log 100 2
explicit-elastic 100 2
explicit-chain 100 2
temperature-single 100 2
temperature-log 100 2
entropy-single 100 2
entropy-log 100 2
CASES
    if [ -n "$features" ]; then
        echo "satellite 3 3"
    fi
}

count_all() {
    cases | while read -r name steps field; do
        once=$(count "$name" "$steps")
        twice=$(count "$name" $((2 * steps)))
        echo "$once $twice" | awk -v name="$name" -v field="$field" \
            '{ printf "%-20s %.0f\n", name, ($4 - $1) / ($(3 + field) - $field) }'
    done
}

if [ -n "$features" ]; then
    count_all | tee ${1:+"$1"}
    exit
fi
# Fewer instructions than noted fail, too: a later change could lose them unseen.
count_all | awk -v expected="$expected" '
    BEGIN { while ((getline line < expected) > 0) if (line !~ /^#/) { split(line, of); noted[of[1]] = of[2] } }
    {
        ratio = $2 / noted[$1]
        far = ratio < 0.98 || ratio > 1.02
        printf "%-20s %8d  %.3f of %d%s\n", $1, $2, ratio, noted[$1], far ? "  DIFFERS" : ""
        wrong += far
    }
    END {
        if (wrong) print "If the change is meant, write the new numbers into " expected ", and the reason into the commit message."
        exit wrong > 0
    }'
