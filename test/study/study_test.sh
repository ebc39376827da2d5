#!/bin/sh
# The files of the study are the same bytes in one run, in shards, and after a kill; what cannot be done is said, and nothing is lost.
# usage: study_test.sh feeler-study folder
set -eu
here=$(cd "$(dirname "$0")" && pwd)
study=$1
folder=$2
rm -rf "$folder"
mkdir -p "$folder"
cd "$folder"
choose='--quick --scene cavity_1mm,wedge_4 --sweep margin,iterations --seconds 0.2 --no-figures'
fail() {
  echo "study_test: $*" >&2
  exit 1
}
# usage: refuses words option…: exit code 2, and a sentence with these words
refuses() {
  words=$1
  shift
  code=0
  "$study" "$@" >/dev/null 2>said || code=$?
  [ $code = 2 ] || fail "exit code $code, not 2: $*"
  grep -q -e "$words" said || fail "'$words' is not in: $(cat said)"
}

# shellcheck disable=SC2086
{
  "$study" $choose --out whole
  [ "$(wc -l <whole/study.csv)" = 17 ] || fail "16 cells and a head were to be written"
  # Operations are counted where the scalar counts them; there the tool goes as in double, but for rounding.
  awk -F, '
    NR == 1 { for (i = 1; i <= NF; ++i) column[$i] = i; next }
    { key = $column["scene"]
      for (i = column["margin_m"]; i <= column["offset_m"]; ++i) key = key "," $i
      figures[$column["rendering"], key] = $column["error_median_m"] "," $column["work_median"]
      median = $column["operations_median"]; p99 = $column["operations_p99"] }
    $column["rendering"] != "counted" { bad = bad || median != "" || p99 != ""; next }
    { ++count; keys[key]; bad = bad || median < 1000 || p99 < median }
    END { for (key in keys) bad = bad || figures["double", key] != figures["counted", key]
          exit bad || count != 6 }' whole/study.csv || fail "operations of 6 cells were to be counted, with the median error and work of double"
  for i in 1 2 3; do "$study" $choose --shard $i/3 --out part$i; done
  "$study" --merge part1 part2 part3 --out merged --no-figures
  cmp whole/study.csv merged/study.csv
  # Many machines: a task of a cluster each, or GNU parallel. A task that is submitted alone is the shard that it was.
  for i in 1 2 3; do
    FEELER_STUDY=$study FEELER_STUDY_OUT=cluster FEELER_STUDY_SHARDS=3 SLURM_ARRAY_TASK_ID=$i SLURM_ARRAY_TASK_COUNT=1 bash "$here/../../bench/study/study.slurm" $choose
  done
  "$study" --merge cluster/part* --out merged --no-figures
  cmp whole/study.csv merged/study.csv
  if command -v parallel >/dev/null; then
    parallel --will-cite "$study" $choose --shard {}/3 --out beside/part{} ::: 1 2 3
    "$study" --merge beside/part* --out merged --no-figures
    cmp whole/study.csv merged/study.csv
  else
    echo 'study_test: GNU parallel is not here; its line is not tested'
  fi

  rm part2/study.csv
  refuses 'is not there' --merge part1 part2 part3 --out merged
  refuses 'is in none of the folders' --merge part1 part3 --out none
  refuses 'study_times.csv holds rows of another study' $choose --seed 2 --shard 2/3 --out part2
  rm part2/study_times.csv
  "$study" $choose --seed 2 --shard 2/3 --out part2
  refuses 'not of one study: seed is 2 and not 1 in part2/study.csv' --merge part1 part2 part3 --out none
  # As many cells, but others: of another sweep, and of other values of the same one.
  "$study" --quick --scene cavity_1mm,wedge_4 --sweep rate,budget --seconds 0.2 --no-figures --shard 2/3 --out other_cells
  [ "$(cut -d, -f40 part1/study.csv | tail -n 1)" = "$(cut -d, -f40 other_cells/study.csv | tail -n 1)" ] || fail "as many cells were to be in both"
  refuses 'not of one study: the cells, motion or build are others (--scene' --merge part1 other_cells part3 --out none
  cp part3/study.csv other_cells
  refuses 'not of one study.* in other_cells/study_times.csv' --merge part1 part3 other_cells --out none
  "$study" $choose --seed 2 --out other
  refuses 'holds another study' --merge other --out merged

  # Killed: some rows, the last of them cut in half.
  mkdir killed
  head -n 5 whole/study.csv >killed/study.csv
  tail -n 1 whole/study.csv | cut -c 1-40 | tr -d '\n' >>killed/study.csv
  head -n 6 whole/study_times.csv >killed/study_times.csv
  refuses 'was cut short' --merge killed --out merged
  "$study" $choose --out killed | grep -q '12 cells measured, 4 were there' || fail "a run that was killed was to go on"
  cmp whole/study.csv killed/study.csv

  cp other/study_times.csv part1/study_times.csv
  refuses 'study_times.csv holds rows of another study' $choose --shard 1/3 --out part1

  refuses 'another study: seed is 1 and not 2' $choose --seed 2 --out whole
  refuses 'another study: the cells' --quick --scene cavity_1mm,wedge_4 --sweep rate,budget --seconds 0.2 --no-figures --out whole
  refuses 'cannot be made' $choose --out /dev/null/study

  # Text where a number belongs.
  mkdir odd
  awk -F, -v OFS=, 'NR == 4 { $18 = "much" } { print }' whole/study.csv >odd/study.csv
  cp whole/study_times.csv odd
  for what in '--tables' '--figures' "$choose"; do
    refuses "odd/study.csv has in line 4, column error_p99_m, 'much' where" $what --out odd
  done
  refuses "odd/study.csv has in line 4, column error_p99_m, 'much' where" --merge odd --out merged
  sed '4s/^[0-9]*/one/' whole/study.csv >odd/study.csv
  refuses "line 4, column cell, 'one'" --merge odd --out merged

  # Tables, and figures that are whole or not there.
  "$study" --tables --out whole | grep -q 'samples of each' || fail "--tables prints tables"
  if command -v gnuplot >/dev/null; then
    "$study" --figures --out whole
    grep -q '</svg>' whole/study_choices.svg || fail "the figure was to be whole"
    echo old >whole/study_choices.svg
    code=0
    (ulimit -f 32 && "$study" --figures --out whole) >/dev/null 2>said || code=$?
    [ $code = 2 ] || fail "a figure that does not fit on the disk was to be refused, not $code"
    grep -q 'cannot be drawn\|cannot be written' said || fail "what cannot be drawn is not in: $(cat said)"
    [ "$(cat whole/study_choices.svg)" = old ] || fail "the figure that was there was to stay"
  fi
  code=0
  env PATH=/nowhere "$study" --figures --out whole 2>said || code=$?
  [ $code = 2 ] || fail "exit code $code, not 2, without gnuplot"
  grep -q 'install gnuplot' said || fail "gnuplot is not in: $(cat said)"

  # A disk that is full, to the program: files of no more than 2 kB.
  (
    ulimit -f 4
    refuses 'cannot be written' $choose --out full
  )
  "$study" $choose --out full | grep -q ', 0 were there' && fail "rows were lost"
  cmp whole/study.csv full/study.csv
}
# A cell that is rendered and has no truth: no free pose keeps a margin that is wider than the fit.
for what in --shard=1/1 --tables; do
  "$study" $what --scene bore_24 --sweep scale --rendering double --only scale=0.01,1 --seconds 0.1 --out without_truth --no-figures >said
done
grep -q '^| 0.01 | [0-9./ ]* | – .* 1, no truth 1 | 0 to 0 |$' said || fail "no truth was to be told in: $(cat said)"
[ "$(sed -n 2p without_truth/study.csv | cut -d, -f14,15,17,18,20)" = 0,5,,,0 ] || fail "errors that were not measured were to be left empty"

refuses 'holds no rows' --tables --out empty
mkdir empty
refuses 'holds no rows' --tables --out empty
mkdir empty/study.csv
refuses 'is not a file of rows' --tables --out empty
refuses 'is not a file of rows' --figures --out empty
printf 'colour,shape\nred,round\n' >whole/study.csv
refuses 'names other columns' --tables --out whole
refuses 'names other columns' --sweep margin --scene wedge_4 --out whole
refuses 'There is no scene cavern' --scene cavern
refuses 'There is no sweep colour' --sweep colour
refuses 'There is no motion still; there are: usual slow quick trembling' --motion still
refuses 'leave no cell' --sweep offset --scene cavity_1mm
refuses 'such as 2/8' --shard 9/8
refuses 'such as 2/8' --shard some
refuses 'such as 2/8' --shard ''
refuses 'There is no scene' --prove 3 --scene nosuch
refuses 'There is no rendering fast.*FEELER_STUDY_RENDERINGS' --rendering fast
refuses '0 is not a number from 1 to 1000000' --prove 0
refuses 'nan is not a number from 0.1 to 1000' --seconds nan
refuses '--only is colour=1; give.*such as margin=1e-6' --only colour=1
refuses '--only is margin=wide' --only margin=wide
refuses '--only is rate;' --only rate
refuses 'leave no cell with the rate 3000' --only rate=1000,3000
"$study" --list | grep -q 'what does the margin cost' || fail "--list names the sweeps"
list() { "$study" --list --rendering double "$@" | sed '1,/^cells/d'; }
[ "$(list --only margin=1e-7,1e-6 rate=1000 --sweep margin --scene wedge_4 | wc -l)" = 2 ] || fail "--only was to leave two cells"
[ "$(list --only rate=4000 | wc -l)" = "$(list --sweep rate | grep -c rate=4000)" ] || fail "--only was to leave the cells of one rate"
list >all
for i in 1 2 3; do list --shard $i/3; done | sort -n | cmp - all || fail "--list was to name the cells of a shard"
[ "$(wc -l <all)" -gt "$(list --shard 1/3 | wc -l)" ] || fail "a shard has fewer cells"
# What is left is not known before a cell has ended.
timeout 2 "$study" --sweep front --no-figures --out progress 2>said || true
grep -q '^\[0/[0-9]*\]$' said || fail "no time is left at the start: $(head -n 1 said)"
