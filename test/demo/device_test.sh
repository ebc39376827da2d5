#!/bin/sh
# Real devices as the demo meets them: makers' libraries that are missing or too old, and sessions with libraries that stand in for them.
# usage: device_test.sh feeler-demo scratch-folder folder-of-stand-ins
set -u
demo=$1
scratch=$2
stand_ins=$3
failures=0
FEELER_STAND_IN_RUNS_BY_ITSELF=1
export FEELER_STAND_IN_RUNS_BY_ITSELF

rm -rf "$scratch"
mkdir -p "$scratch"
cd "$scratch" || exit 1

fail() {
  echo "FAILED: $1"
  failures=$((failures + 1))
}

"$demo" --list-devices >list.txt 2>error.txt || fail "the list ends with exit code $?: $(cat error.txt)"
[ ! -s error.txt ] || fail "the list has words on the error stream: $(cat error.txt)"
for device in openhaptics forcedimension virtuose haply simulated; do
  [ "$(grep -c "^$device: " list.txt)" -eq 1 ] || fail "the list does not say one thing of $device"
done
grep '^[a-z]*: none' list.txt | grep -vq 'install\|check\|calibrate\|switch' && fail "the list leaves a user helpless: $(cat list.txt)"

for pair in openhaptics:open_haptics forcedimension:force_dimension virtuose:virtuose; do
  device=${pair%:*}
  library=$stand_ins/lib${pair#*:}_stand_in

  "$demo" --scene cavity --seconds 0.2 --device "$device" --device-library "$library.so" --record --out "$device" >output.txt 2>error.txt ||
    fail "$device: exit code $?: $(cat error.txt)"
  grep -q 'force safety' output.txt || fail "$device: the table does not say what the safety did"
  grep -q 'simulated' "$device/scene.json" && fail "$device: the report calls it simulated"
  "$demo" --replay "$device/session.feeler" >output.txt 2>error.txt || fail "$device: the replay differs: $(cat output.txt error.txt)"
  grep -q '200 ticks.*same to the last bit' output.txt || fail "$device: the replay says $(cat output.txt)"

  # The same device as the hand of the live view; the program may be built without it.
  "$demo" --view --port 0 --seconds 0.2 --device "$device" --device-library "$library.so" >output.txt 2>error.txt ||
    grep -q 'built without' error.txt || fail "$device: the live view ends with exit code $?: $(cat error.txt)"
  grep -q 'ticks: 200' output.txt || grep -q 'built without' error.txt || fail "$device: of its live view it says $(cat output.txt)"

  "$demo" --scene cavity --device "$device" --device-library "${library}_of_an_older_version.so" --out old >output.txt 2>error.txt
  [ $? -eq 2 ] || fail "$device: an older library is no bad input"
  grep -q 'has no function' error.txt || fail "$device: of an older library it says $(cat error.txt)"
  [ "$(wc -l <error.txt)" -eq 1 ] || fail "$device: not one sentence: $(cat error.txt)"
  [ ! -e old ] || fail "$device: a report of nothing"
done

# The second of two, by its serial number and by its index; the stand-in says so in its sentence, because it has one device only.
for choice in '--serial-number 1004' '--device-index 4'; do
  # shellcheck disable=SC2086  # two words
  "$demo" --scene cavity --device forcedimension --device-library "$stand_ins/libforce_dimension_stand_in.so" $choice --out absent >output.txt 2>error.txt
  [ $? -eq 2 ] || fail "a device that is not there is found by $choice"
  grep -q "${choice#* }" error.txt || fail "of $choice it says $(cat error.txt)"
done
"$demo" --scene cavity --seconds 0.2 --device forcedimension --device-library "$stand_ins/libforce_dimension_stand_in.so" --serial-number 1003 --out chosen \
  >output.txt 2>error.txt || fail "the device of the serial number 1003: $(cat error.txt)"

# An Inverse Service of Haply.
if [ -x "$stand_ins/haply-stand-in" ]; then
  "$stand_ins/haply-stand-in" "$scratch/address" &
  service=$!
  for _ in $(seq 50); do [ -e address ] || sleep 0.1; done
  "$demo" --scene cavity --seconds 0.2 --device haply --device-address "$(cat address)" --serial-number 049D --out haply >output.txt 2>error.txt ||
    fail "haply: exit code $?: $(cat error.txt)"
  grep -q 'simulated' haply/scene.json && fail 'haply: the report calls it simulated'
  "$demo" --view --port 0 --seconds 0.2 --device haply --device-address "$(cat address)" >output.txt 2>error.txt || grep -q 'built without' error.txt ||
    fail "haply: the live view ends with exit code $?: $(cat error.txt)"
  grep -q 'ticks: 200' output.txt || grep -q 'built without' error.txt || fail "haply: of its live view it says $(cat output.txt)"
  "$demo" --scene cavity --device haply --device-address "$(cat address)" --serial-number FFFF --out absent >output.txt 2>error.txt
  [ $? -eq 2 ] || fail 'haply: an arm that is not there is found'
  grep -q 'knows 049D' error.txt || fail "haply: of an arm that is not there it says $(cat error.txt)"
  kill "$service"
fi

# A tick of another session is found.
cp openhaptics/session.feeler changed.feeler
printf '\001' | dd of=changed.feeler bs=1 seek=$(($(wc -c <changed.feeler) - 40)) conv=notrunc 2>dd.txt
"$demo" --replay changed.feeler >output.txt 2>error.txt
[ $? -eq 1 ] || fail "a changed session is replayed as if it were the same: $(cat output.txt error.txt)"

"$demo" --scene cavity --seconds 0.2 --rate 20000 --device openhaptics --device-library "$stand_ins/libopen_haptics_stand_in.so" --out fast \
  >output.txt 2>error.txt
[ $? -eq 2 ] || fail 'a rate that the device does not have is accepted'
grep -q 'runs at' error.txt || fail "of a rate that it does not have it says $(cat error.txt)"

[ "$failures" -eq 0 ] || { echo "$failures failures"; exit 1; }
echo 'devices are found, or missed in a sentence'
