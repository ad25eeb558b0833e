# The steps that tools/run and tools/test share: quiet, whole output in build/logs. Sourced after `root` is set.

logs="$root/build/logs"
tested_presets="$(sed -n '/"testPresets"/,$s/.*"name": "\([^"]*\)".*/\1/p' "$root/CMakePresets.json" | tr '\n' ' ')"

# jobs: one for each core, but no more than one for each 1.5 GB of memory: that is what our largest sources take.
jobs() {
  local cores memory_kb=0
  [[ -z ${CMAKE_BUILD_PARALLEL_LEVEL:-} ]] || { printf '%s\n' "$CMAKE_BUILD_PARALLEL_LEVEL"; return; }
  cores="$(getconf _NPROCESSORS_ONLN)"
  ! command -v nproc >/dev/null || cores="$(nproc)"
  [[ ! -r /proc/meminfo ]] || memory_kb="$(awk '/^MemAvailable:/ {print $2}' /proc/meminfo)"
  if ((memory_kb > 0 && memory_kb / 1500000 < cores)); then cores=$((memory_kb / 1500000)); fi
  printf '%d\n' $((cores > 0 ? cores : 1))
}

# progress STEP: from ninja's output on stdin, its count: on a terminal as it moves, into a pipe only at each quarter.
progress() {
  local line quarter last=0 counted=no
  while IFS= read -r line; do
    [[ $line =~ ^\[([0-9]+)/([0-9]+)\] ]] || continue
    if [[ -t 1 ]]; then
      printf '\r%s: %d of %d ' "$1" "${BASH_REMATCH[1]}" "${BASH_REMATCH[2]}"
      counted=yes
      continue
    fi
    quarter=$((4 * BASH_REMATCH[1] / BASH_REMATCH[2]))
    ((quarter == last)) || printf '%s: %d of %d\n' "$1" "${BASH_REMATCH[1]}" "${BASH_REMATCH[2]}"
    last=$quarter
  done
  [[ $counted == no ]] || printf '\n'
}

# step NAME COMMAND...: runs it from the repository root, output into build/logs/NAME.log; a failure shows its cause.
step() {
  local name="$1" log="$logs/$1.log" status=0
  shift
  mkdir -p "$logs"
  (cd "$root" && "$@") 2>&1 </dev/null | tee "$log" | progress "$name" || status=$?
  ((status == 0)) && return 0
  # ninja goes on with what is under way after a failure, so the cause may stand well above the end.
  if grep -q '^FAILED: ' "$log"; then sed -n '/^FAILED: /,$p' "$log" | head -n 60 >&2; else tail -n 40 "$log" >&2; fi
  printf '%s failed (exit code %d); whole log in %s\n' "$name" "$status" "$log" >&2
  return "$status"
}

# build PRESET [TARGET]: set up, configure, compile.
build() {
  local preset="$1" target=()
  [[ -z ${2:-} ]] || target=(--target "$2")
  "$root/tools/setup" --quiet || return
  step "configure-$preset" cmake --preset "$preset" || return
  step "build-$preset" cmake --build --preset "$preset" --parallel "$(jobs)" "${target[@]}"
}
