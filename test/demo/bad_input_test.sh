#!/bin/sh
# Every input that the demo cannot use: exit code 2, one sentence on the error stream, and no report.
# usage: bad_input_test.sh feeler-demo scratch-folder
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

# refuses NAME PATTERN ARGUMENT…: the sentence must match the pattern.
refuses() {
  name=$1
  pattern=$2
  shift 2
  "$demo" --seconds 0.05 --out report/deep "$@" >output.txt 2>error.txt
  code=$?
  [ "$code" -eq 2 ] || fail "$name: exit code $code, not 2"
  [ "$(wc -l <error.txt)" -eq 1 ] || fail "$name: not one line on the error stream: $(cat error.txt)"
  grep -qi -- "$pattern" error.txt || fail "$name: the sentence does not say '$pattern': $(cat error.txt)"
  grep -q '\.$' error.txt || fail "$name: no sentence: $(cat error.txt)"
  [ ! -e report ] || fail "$name: a folder was left behind: $(find report)"
  rm -rf report
}

cat >tetrahedron.off <<'END'
OFF
4 4 0
0 0 0
0.02 0 0
0 0.02 0
0 0 0.02
3 0 2 1
3 0 1 3
3 0 3 2
3 1 2 3
END
cat >flat.obj <<'OBJ'
v 0 0 0
v 0.01 0 0
v 0.01 0.01 0
v 0 0.01 0
f 1 2 3
f 1 3 4
OBJ
cat >nan.obj <<'OBJ'
v 0 0 0
v nan 0 0
v 0 0.01 0
f 1 2 3
OBJ
cat >points.obj <<'OBJ'
v 0 0 0
v 0.01 0 0
v 0 0.01 0
OBJ
cat >no_triangles.off <<'END'
OFF
3 0 0
0 0 0
1 0 0
0 1 0
END
cat >no_triangles.ply <<'PLY'
ply
format ascii 1.0
element vertex 3
property float x
property float y
property float z
element face 0
property list uchar int vertex_indices
end_header
0 0 0
1 0 0
0 1 0
PLY
printf 'solid nothing\nendsolid nothing\n' >no_triangles.stl
printf 'this is no mesh\n' >words.stl
: >empty.stl
head -c 200 /dev/zero >zeros.stl
mkdir folder.stl

refuses 'missing object' 'does not exist' --scene file --object missing.stl
refuses 'missing tool' 'does not exist' --scene file --object tetrahedron.off --tool missing.stl
refuses 'empty object' 'empty' --scene file --object empty.stl
refuses 'empty tool' 'empty' --scene file --object tetrahedron.off --tool empty.stl
refuses 'folder as object' 'no file' --scene file --object folder.stl
refuses 'words' 'words.stl' --scene file --object words.stl
refuses 'zeros' 'zeros.stl' --scene file --object zeros.stl
refuses 'points only' 'points.obj' --scene file --object points.obj
refuses 'no triangles in OFF' 'no_triangles.off' --scene file --object no_triangles.off
refuses 'no triangles in PLY' 'no_triangles.ply' --scene file --object no_triangles.ply
refuses 'no triangles in STL' 'no_triangles.stl' --scene file --object no_triangles.stl
refuses 'NaN in the object' 'NaN' --scene file --object nan.obj
refuses 'NaN in the tool' 'NaN' --scene file --object tetrahedron.off --tool nan.obj
refuses 'coplanar tool' 'plane' --scene file --object tetrahedron.off --tool flat.obj
refuses 'tool without object' 'object' --scene file --tool tetrahedron.off
refuses 'start inside' 'penetrates' --scene file --object tetrahedron.off --start 0.002,0.002,0.002
refuses 'cavity too small' 'penetrates' --scene cavity --clearance -0.001
refuses 'unknown option' 'unknown' --unknown
refuses 'unknown scene' 'scene' --scene moon
refuses 'option without value' 'rate' --rate
refuses 'rate that is no number' 'rate' --rate fast
refuses 'rate of zero' 'rate' --rate 0
refuses 'negative seconds' 'seconds' --seconds -1
refuses 'no seconds at all' 'seconds' --seconds nan
refuses 'no triangles' 'triangles' --scene terrain --triangles 0
refuses 'scale of zero' 'scale' --scene file --object tetrahedron.off --scale 0
refuses 'unknown device' 'device' --device ouija
refuses 'library of no maker' 'maker' --device-library libHD.so
refuses 'serial number of no maker' 'maker' --serial-number 5
refuses 'index of no maker' 'maker' --device auto --device-index 1
refuses 'address of no maker' 'maker' --device-address localhost:10001
refuses 'calibration of no maker' 'maker' --initialise
refuses 'serial number that is none' 'serial number' --device forcedimension --serial-number abc
refuses 'serial number of a maker without' 'address' --device virtuose --serial-number 5
refuses 'address that is none' 'no address' --device haply --device-address localhost
refuses 'library of a service' 'no library' --device haply --device-library libHD.so
refuses 'service that does not run' 'no Inverse Service answers' --device haply --device-address localhost:1
refuses 'library that is missing' 'libHD.so: cannot open shared object file' --device openhaptics --device-library /nowhere/libHD.so
refuses 'scale of a simulated workspace' 'device' --workspace-scale 2
refuses 'workspace of no size' 'workspace-scale' --device auto --workspace-scale 0
refuses 'session that is missing' 'cannot be read' --replay missing.feeler
refuses 'session that is none' 'no recording' --replay tetrahedron.off
refuses 'view with a report' 'no report' --view
refuses 'port without a view' 'view' --port 4280
refuses 'scene that is only seen' 'view' --scene spline
refuses 'recording on a device' 'leave --device out' --view --replay a.feeler --device openhaptics
refuses 'two sessions' 'view' --replay a.feeler b.feeler
refuses 'file for another scene' 'scene' --scene cavity --object tetrahedron.off

# A folder with something else in it is not replaced.
mkdir precious
echo keep >precious/letter.txt
"$demo" --scene cavity --seconds 0.05 --out precious >output.txt 2>error.txt
[ $? -eq 2 ] || fail 'a folder that is no report was taken'
[ "$(cat precious/letter.txt)" = keep ] || fail 'a file of the user was lost'

[ "$failures" -eq 0 ] || { echo "$failures failures"; exit 1; }
echo 'every bad input is refused'
