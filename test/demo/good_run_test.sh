#!/bin/sh
# A short run, and its folder as somebody reads it who knows nothing of the program.
# usage: good_run_test.sh feeler-demo scratch-folder
set -u
demo=$1
scratch=$2
failures=0

rm -rf "$scratch"
mkdir -p "$scratch"
cd "$scratch" || exit 1

fail() {
  echo "FAILED: $1"
  failures=$((failures + 1))
}

"$demo" --scene cavity --seconds 0.5 --rate 1000 --seed 7 --out run >output.txt 2>error.txt
code=$?
[ "$code" -eq 0 ] || fail "exit code $code: $(cat error.txt)"
[ ! -s error.txt ] || fail "words on the error stream: $(cat error.txt)"
for word in 'missed deadlines' 'p99.9' 'deepest penetration' 'converged' 'peak force'; do
  grep -q "$word" output.txt || fail "the table does not say '$word'"
done
for file in object.off tool.off ticks.csv path.csv scene.json report.html; do
  [ -s "run/$file" ] || fail "$file is missing or empty"
done
ls | grep -q partial && fail 'an unfinished folder was left behind'

# OFF: the cavity has 8 vertices and 12 triangles, the cube 8 vertices.
[ "$(sed -n 1,2p run/object.off | tr '\n' ' ')" = 'OFF 8 12 0 ' ] || fail 'object.off is not the cavity'
[ "$(sed -n 2p run/tool.off | cut -d' ' -f1)" = 8 ] || fail 'tool.off is not a cube'
# 17 digits: the height of the room is 0.0105, which no double is.
grep -q '0\.0105000000000000' run/object.off || fail 'object.off does not have 17 digits'

header='t,haptic_px,haptic_py,haptic_pz,haptic_qw,haptic_qx,haptic_qy,haptic_qz'
header=$header',graphic_px,graphic_py,graphic_pz,graphic_qw,graphic_qx,graphic_qy,graphic_qz'
header=$header',fx,fy,fz,tx,ty,tz,contacts,rows,iterations,converged,tick_us'
[ "$(head -n 1 run/ticks.csv)" = "$header" ] || fail "the columns are $(head -n 1 run/ticks.csv)"
[ "$(wc -l <run/ticks.csv)" -eq 501 ] || fail "ticks.csv has $(wc -l <run/ticks.csv) lines, not 501"
awk -F, 'NR > 1 {
  if (NF != 26) { print "line " NR " has " NF " columns"; exit 1 }
  for (i = 1; i <= NF; i++) if ($i !~ /^-?[0-9.]+(e[-+][0-9]+)?$/) { print "line " NR ": " $i; exit 1 }
  for (q = 5; q <= 12; q += 7) {
    n = $q * $q + $(q+1) * $(q+1) + $(q+2) * $(q+2) + $(q+3) * $(q+3)
    if (n < 0.999999999 || n > 1.000000001) { print "line " NR ": quaternion of length " n; exit 1 }
  }
  # F = 1000 N/m (p_g - p_h), to the digits of the file
  for (k = 0; k < 3; k++) {
    d = $(16+k) - 1000 * ($(9+k) - $(2+k))
    if (d > 1e-9 || d < -1e-9) { print "line " NR ": force off by " d; exit 1 }
  }
  if ($26 <= 0) { print "line " NR ": no time"; exit 1 }
}' run/ticks.csv >awk.txt || fail "ticks.csv: $(cat awk.txt)"

# The way begins at the start and never leaves a tick out; a tick ends where ticks.csv says that the tool is.
[ "$(head -n 1 run/path.csv)" = 'tick,t,px,py,pz,qw,qx,qy,qz' ] || fail "the columns are $(head -n 1 run/path.csv)"
awk -F, '
  function bad(what) { print FILENAME " line " FNR ": " what; failed = 1; exit 1 }
  function end_of_tick() { if (last >= 0 && (pose != graphic[last] || time != t[last])) bad("tick " last " ends elsewhere") }
  FNR == 1 { next }
  NR == FNR { t[FNR - 2] = $1; graphic[FNR - 2] = $9 "," $10 "," $11 "," $12 "," $13 "," $14 "," $15; ticks = FNR - 1; next }
  NF != 9 { bad(NF " columns") }
  FNR == 2 { if ($1 != -1 || $3 != 0 || $4 != 0 || $5 != 0 || $6 != 1) bad("this is not the start"); last = -1; next }
  {
    n = $6 * $6 + $7 * $7 + $8 * $8 + $9 * $9
    if (n < 0.999999999 || n > 1.000000001) bad("quaternion of length " n)
    if ($1 != last && $1 != last + 1) bad("tick " $1 " after " last)
    if ($1 != last) end_of_tick()
    last = $1; time = $2; pose = $3 "," $4 "," $5 "," $6 "," $7 "," $8 "," $9
  }
  END { if (!failed) { end_of_tick(); if (last != ticks - 1) bad("the last tick is " last); if (FNR <= ticks + 2) bad("no tick has a corner") } }
' run/ticks.csv run/path.csv >awk.txt || fail "path.csv: $(cat awk.txt)"

for key in seed rate_Hz compiler commit margin_m stiffness_translational_N_per_m penetrated; do
  grep -q "\"$key\"" run/scene.json || fail "scene.json has no $key"
done
grep -q '"seed": 7' run/scene.json || fail 'scene.json has another seed'

if command -v gnuplot >/dev/null; then
  for figure in wrench.svg wrench.png tick_time.svg tick_time.png run.png; do
    [ -s "run/$figure" ] || fail "$figure is missing"
  done
  [ "$(grep -c '</svg>' run/report.html)" -ge 1 ] || fail 'the page shows no figure'
fi
grep -qE '(src|href)="(https?:|[a-z_]+\.(svg|png|css|js))' run/report.html && fail 'the page needs other files'

# A second run takes the place of the first; without gnuplot there is a report all the same.
mkdir empty_path
PATH=$scratch/empty_path "$demo" --scene cavity --seconds 0.1 --out run >output.txt 2>error.txt
code=$?
[ "$code" -eq 0 ] || fail "without gnuplot: exit code $code: $(cat error.txt)"
grep -q gnuplot output.txt || fail 'nothing says that gnuplot is missing'
[ -s run/report.html ] || fail 'without gnuplot: no page'
[ ! -e run/wrench.svg ] || fail 'a figure of the first run is still there'

# The live view opens a browser where there is a desktop, and nowhere else; the program may be built without it.
mkdir desktop
printf '#!/bin/sh\necho "$@" >>"%s/opened.txt"\nsleep 5\n' "$scratch" >desktop/xdg-open
chmod +x desktop/xdg-open
for variable in DISPLAY WAYLAND_DISPLAY NO_DESKTOP; do
  rm -f opened.txt
  env -u DISPLAY -u WAYLAND_DISPLAY "$variable=:7" "PATH=$scratch/desktop:$PATH" "$demo" --view --port 0 --seconds 0.5 >output.txt 2>error.txt
  code=$?
  ! grep -q 'built without' error.txt || break
  [ "$code" -eq 0 ] || fail "the live view with $variable: exit code $code: $(cat error.txt)"
  if [ "$variable" = NO_DESKTOP ]; then
    [ ! -e opened.txt ] || fail "without a desktop $(cat opened.txt) is opened"
  else
    for _ in $(seq 50); do [ -s opened.txt ] || sleep 0.1; done
    address=$(grep -o 'http:[^ ]*' output.txt)
    [ "$(cat opened.txt)" = "$address" ] || fail "of $variable it opens '$(cat opened.txt)' and not $address"
    port=${address##*:}
    env -u DISPLAY -u WAYLAND_DISPLAY "$demo" --view --port "${port%/}" --seconds 0.1 >output.txt 2>error.txt || fail "the browser keeps the port of a program that has ended: $(cat error.txt)"
  fi
done
PATH=$scratch/empty_path DISPLAY=:7 "$demo" --view --port 0 --seconds 0.2 >output.txt 2>error.txt || grep -q 'built without' error.txt ||
  fail "a desktop without xdg-open ends the live view: $(cat error.txt)"

[ "$failures" -eq 0 ] || { echo "$failures failures"; exit 1; }
echo 'the folder holds what it says'
