# Options of the commands of tools/ in bash, which source this file: --help, -o FOLDER, and flags of their own.
#
# read_options KNOWN.. -- ARGUMENT..   sets `output` to the FOLDER of -o (made absolute; empty without it) and `given` to the other
#                                      known options among the arguments; ends the command with --help, or with a sentence and
#                                      status 1 if an argument is wrong
# The comment at the head of a command is its help.

command_name=$(basename "$0")

refuse() {
  echo "$command_name: $1" >&2
  exit 1
}

usage() {
  sed -n '2,/^[^#]/s/^# \{0,1\}//p' "$(readlink -f "$0")"
  exit 0
}

# did_you_mean WORD KNOWN..: the known word from which it differs in the fewest letters, or all of them.
did_you_mean() {
  awk 'function least(a, b) { return a < b ? a : b }
    function distance(a, b,   i, j, d) {
      for (i = 0; i <= length(a); i++) d[i, 0] = i
      for (j = 0; j <= length(b); j++) d[0, j] = j
      for (i = 1; i <= length(a); i++) for (j = 1; j <= length(b); j++)
        d[i, j] = least(least(d[i - 1, j], d[i, j - 1]) + 1, d[i - 1, j - 1] + (substr(a, i, 1) != substr(b, j, 1)))
      return d[length(a), length(b)]
    }
    BEGIN {
      for (k = 2; k < ARGC; k++) {
        all = all (k > 2 ? ", " : "") ARGV[k]
        if (k == 2 || distance(ARGV[1], ARGV[k]) < distance(ARGV[1], near)) near = ARGV[k]
      }
      if (distance(ARGV[1], near) <= length(near) / 3) printf "; did you mean \x27%s\x27?", near
      else printf " (there are: %s)", all
    }' "$@"
}

read_options() {
  local known=() word
  while [ "$1" != -- ]; do
    known+=("$1")
    shift
  done
  shift
  output='' given=()
  while [ $# -gt 0 ]; do
    word=$1
    case "$word" in
      -h | --help) usage ;;
      -o | --output | --output=)
        [ -n "${2:-}" ] && [ "$word" != --output= ] || refuse "${word%=} needs a FOLDER (--help shows the options)"
        output=$2
        shift
        ;;
      --output=?*) output=${word#*=} ;;
      -*)
        [[ " ${known[*]} " == *" $word "* ]] || refuse "'${word%%=*}' is not an option$(did_you_mean "${word%%=*}" "${known[@]}" --help --output)"
        given+=("$word")
        ;;
      *) refuse "'$word' is one argument too many (--help shows what is expected)" ;;
    esac
    shift
  done
  [ -z "$output" ] || output=$(realpath -m -- "$output")
}
