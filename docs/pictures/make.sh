#!/usr/bin/env bash
# Draws the pictures of README.md and docs/. Needs gnuplot, jq, awk, and numpy.
#   docs/pictures/make.sh [the program; default: build/poise]
set -euo pipefail
export LC_ALL=C.UTF-8  # gnuplot knows the degree sign
poise=$(realpath "${1:-$(dirname "$0")/../../build/poise}")
cd "$(dirname "$0")"
examples=../../examples
work=$(mktemp -d)
trap 'rm -r "$work"' EXIT

# Few colours, each with one meaning, as in `poise curve --plot`.
force='#0b5394' cone='#b9d5ec' weight='#a61c00' limit='#e69138' object='#f1efe9' line='#555555'
unholdable='#d4d4d4' best='#38761d'

# picture NAME WIDTH HEIGHT < script
picture() {
  {
    echo "set terminal svg size $2,$3 enhanced font 'sans-serif,15' background '#ffffff' linewidth 1"
    echo "set style textbox opaque fc rgb '#aaffffff' noborder margins 0.3,0.3"
    echo "force='$force'; cone='$cone'; weight='$weight'; limit='$limit'; object='$object'"
    echo "line='$line'; unholdable='$unholdable'; best='$best'"
    cat
  } | gnuplot --default-settings > "$work/$1.svg"
  mv "$work/$1.svg" "$1.svg"
  echo "$1.svg"
}

# ---- A held part beside its posture curve: README ----------------------------------------------

"$poise" curve "$examples/l-part.yaml" --plot held-part.svg > /dev/null
echo held-part.svg

# ---- A bottle as it hangs: README --------------------------------------------------------------

"$poise" draw "$examples/bottle.yaml" --up=-0.998,0,0.070 -o bottle.svg > /dev/null
echo bottle.svg

# ---- Examples of loads: docs/grasp-file.md; of a motion: docs/command-line.md ------------------

for example in "shaken-bottle 0,0,1" "screwdriver 0,0,1" "sheet-under-cups 0,1,0"; do
  read -r example up <<< "$example"
  "$poise" draw "$examples/$example.yaml" --up "$up" -o "$example.svg" > /dev/null
  echo "$example.svg"
done
"$poise" motion "$examples/pick-and-place.yaml" "$examples/motions/pick-and-place.csv" \
  --plot pick-and-place.svg > /dev/null
echo pick-and-place.svg

# ---- The planar cone and its projection --------------------------------------------------------

picture projection 940 490 << 'END'
mu = 0.6; lo = 1.2; hi = 3.2
a = 1 + mu**2
# The projection, in the three cases of the text.
clamp(x) = x < lo ? lo : x > hi ? hi : x
side(x) = x < 0 ? -1. : 1.
inside(n, t) = abs(t) < mu * clamp(n)
Pn(n, t) = inside(n, t) ? clamp(n) : clamp((n + mu * abs(t)) / a)
Pt(n, t) = inside(n, t) ? t : side(t) * mu * clamp((n + mu * abs(t)) / a)

unset key; unset border; unset tics
set size ratio -1
T = 3.1
flat = '#e4f0db'; edge = '#fbe5cd'; corner = '#ededed'
set style fill solid 1 noborder
set multiplot layout 1,2 margins 0.01,0.99,0.03,0.9 spacing 0.02

$z << end
2.0 0.35
0.2 0.3
4.4 -0.9
1.4 1.75
2.4 -1.9
-0.2 1.9
4.0 2.75
0.3 -1.5
end
set title 'with limits: least and greatest normal force' offset 0,-0.3
set xrange [-1:5.2]; set yrange [-T:T]
set object 1 polygon from lo,mu*lo to hi,mu*hi to hi,-mu*hi to lo,-mu*lo to lo,mu*lo fc rgb cone front
set object 1 fs solid 1 border rgb force lw 1.6
set object 2 rectangle from -1,-mu*lo to lo,mu*lo fc rgb flat fs solid 1 noborder behind
set object 3 rectangle from hi,-mu*hi to 5.2,mu*hi fc rgb flat fs solid 1 noborder behind
do for [s=-1:1:2] {
  u = T / mu  # far up along the normal (-mu, 1) of the edge
  set object 5+s polygon from lo,s*mu*lo to hi,s*mu*hi to hi-mu*(T-mu*hi),s*T to lo-mu*(T-mu*lo),s*T to lo,s*mu*lo fc rgb edge behind
  set object 9+s polygon from lo,s*mu*lo to lo-mu*(T-mu*lo),s*T to -1,s*T to -1,s*mu*lo to lo,s*mu*lo fc rgb corner behind
  set object 13+s polygon from hi,s*mu*hi to hi-mu*(T-mu*hi),s*T to 5.2,s*T to 5.2,s*mu*hi to hi,s*mu*hi fc rgb corner behind
}
set arrow 1 from -1,0 to 5.1,0 nohead lw 0.8 lc rgb line front
set arrow 2 from 0,-T to 0,T nohead lw 0.8 lc rgb line front
set label 1 'f_n' at 5.15,-0.2 right front
set label 2 'f_t' at 0.08,T-0.2 front
set label 3 'n_{lo}' at lo-0.08,-0.2 right front textcolor rgb force
set label 4 'n_{hi}' at hi+0.08,-0.2 front textcolor rgb force
set label 5 'inside' at 2.15,0.75 center front
set label 6 'flat side' at -0.95,0.45 front
set label 7 'flat side' at 5.1,1.2 right front
set label 8 'edge' at 2.2,2.2 center front
set label 9 'edge' at 2.0,-2.35 center front
set label 10 'corner' at -0.6,2.7 center front
set label 11 'corner' at -0.55,-2.7 center front
set label 12 'corner' at 4.6,2.35 center front
set label 13 'corner' at 4.4,-2.6 center front
set arrow 3 from 0,0 to lo,mu*lo nohead dt 3 lw 1 lc rgb force front
set arrow 4 from 0,0 to lo,-mu*lo nohead dt 3 lw 1 lc rgb force front
plot $z using 1:2:(Pn($1,$2)-$1):(Pt($1,$2)-$2) with vectors head filled size 0.13,18 lw 1.6 lc rgb 'black', \
  $z using 1:2 with points pt 6 ps 0.7 lw 1.5 lc rgb 'black', \
  $z using (Pn($1,$2)):(Pt($1,$2)) with points pt 7 ps 0.45 lc rgb weight

lo = 0; hi = 1e9
unset object; unset arrow; unset label
$y << end
2.6 0.5
0.9 1.9
2.3 -2.3
-1.4 0.5
-0.7 -0.8
end
set title 'without limits'
set xrange [-2.2:4]
set object 1 polygon from 0,0 to 4,mu*4 to 4,-mu*4 to 0,0 fc rgb cone behind
do for [s=-1:1:2] {
  set object 5+s polygon from 0,0 to 4,s*mu*4 to 4,s*T to -mu*T,s*T to 0,0 fc rgb edge behind
  set arrow 5+s from 0,0 to 4,s*mu*4 nohead lw 1.6 lc rgb force front
}
set object 2 polygon from 0,0 to -mu*T,T to -2.2,T to -2.2,-T to -mu*T,-T to 0,0 fc rgb corner behind
set arrow 1 from -2.2,0 to 3.9,0 nohead lw 0.8 lc rgb line front
set arrow 2 from 0,-T to 0,T nohead lw 0.8 lc rgb line front
set label 1 'f_n' at 3.95,-0.2 right front
set label 2 'f_t' at 0.08,T-0.2 front
set label 5 'inside' at 2.9,1.05 center front
set label 8 'edge' at 1.6,2.3 center front
set label 9 'edge' at 1.1,-2.1 center front
set label 10 'apex' at -1.35,-0.28 center front
set label 11 'f_t = μ f_n' at 3.95,2.72 right front textcolor rgb force
plot $y using 1:2:(Pn($1,$2)-$1):(Pt($1,$2)-$2) with vectors head filled size 0.13,18 lw 1.6 lc rgb 'black', \
  $y using 1:2 with points pt 6 ps 0.7 lw 1.5 lc rgb 'black', \
  $y using (Pn($1,$2)):(Pt($1,$2)) with points pt 7 ps 0.45 lc rgb weight
END

# ---- A disk at a kink and beside it ------------------------------------------------------------

# The normal and tangential forces at two postures, of the right and the left contact.
forces() {
  "$poise" hold "$examples/ito-fig6.yaml" --angle "$1" --json |
    jq -r '[.contacts[] | .normal_force, .tangential_force] | map(tostring) | join("; ")' |
    awk -F'; ' -v k="$2" '{printf "n%s_1=%s; t%s_1=%s; n%s_2=%s; t%s_2=%s\n", k, $1, k, $2, k, $3, k, $4}'
}
{
  forces 0 0
  forces 30 30
  cat << 'END'
# The contact frames: inward normal at -p, tangent turned by +90 degrees.
phi = 75 * pi / 180
mu_1 = 1.; mu_2 = 1 / sqrt(3)
px(i, th) = i == 1 ? sin(phi - th) : -sin(phi + th)
py(i, th) = i == 1 ? cos(phi - th) : cos(phi + th)
fx(i, th, n, t) = -n * px(i, th) + t * py(i, th)
fy(i, th, n, t) = -n * py(i, th) - t * px(i, th)

unset key; unset border; unset tics
set size ratio -1
set xrange [-1.5:1.5]; set yrange [-1.22:1.22]
set parametric
set style fill solid 1 noborder
set multiplot layout 1,2 margins 0.01,0.99,0.02,0.9 spacing 0.02
do for [panel=0:1] {
  deg = panel * 30
  th = deg * pi / 180
  array fn[2]; array ft[2]; array mu[2] = [mu_1, mu_2]
  fn[1] = panel ? n30_1 : n0_1; ft[1] = panel ? t30_1 : t0_1
  fn[2] = panel ? n30_2 : n0_2; ft[2] = panel ? t30_2 : t0_2
  scale = 0.042  # radii to a newton
  unset object; unset arrow; unset label
  set object 1 circle at 0,0 size 1 fc rgb object behind
  do for [i=1:2] {
    x = px(i, th); y = py(i, th); e = 0.68
    half = atan(mu[i]) * 180 / pi; towards = atan2(-y, -x) * 180 / pi
    set object 1+i circle at x,y size e arc [towards-half:towards+half] fc rgb cone behind
    set object 5+i polygon from x-0.1*y,y+0.1*x to x+0.1*y,y-0.1*x to 1.08*x+0.1*y,1.08*y-0.1*x to 1.08*x-0.1*y,1.08*y+0.1*x to x-0.1*y,y+0.1*x fc rgb line front
    gx = fx(i, th, fn[i], ft[i]); gy = fy(i, th, fn[i], ft[i]); g = sqrt(gx**2 + gy**2)
    set arrow 10+i from x,y to x+scale*gx,y+scale*gy head filled size 0.09,18 lw 2.5 lc rgb force front
    set label 10+i sprintf('%.2f N', g) at 1.14*x,1.14*y+0.1 front textcolor rgb force
    if (i == 2) { set label 10+i right }
    does = fn[i] * mu[i] > abs(ft[i]) * (1 + 1e-9) ? 'sticks' : 'slips'
    set label 20+i does at 1.14*x,1.14*y-0.03 front
    if (i == 2) { set label 20+i right }
  }
  # The lines of the two forces meet on the vertical.
  f1x = fx(1, th, fn[1], ft[1]); f1y = fy(1, th, fn[1], ft[1])
  my = py(1, th) - px(1, th) * f1y / f1x
  do for [i=1:2] { set arrow 30+i from px(i, th),py(i, th) to 0,my nohead dt 2 lw 1.2 lc rgb force front }
  set arrow 40 from 0,-1.2 to 0,1.2 nohead dt 3 lw 1 lc rgb line back
  set arrow 41 from 0,0 to 0,-10*scale head filled size 0.09,18 lw 2.5 lc rgb weight front
  set label 41 '10 N' at 0.06,-0.38 front textcolor rgb weight
  set label 42 'com' at 0.07,0.03 front
  set label 43 (panel ? 'M' : 'M') at 0.07,my+0.09 front font 'sans-serif:Italic'
  set title sprintf(panel ? 'θ = %d°, the kink: force norm %.2f N' : 'θ = %d°: force norm %.2f N', deg, sqrt(fn[1]**2 + ft[1]**2 + fn[2]**2 + ft[2]**2)) offset 0,-0.5
  plot [0:2*pi] cos(t), sin(t) with lines lw 1 lc rgb line, \
    '+' using (0):(0) every ::0::0 with points pt 7 ps 0.8 lc rgb weight, \
    '+' using (0):(my) every ::0::0 with points pt 6 ps 1.2 lw 2 lc rgb force
}
END
} | picture kink 1100 500

# ---- A posture curve, arc by arc ---------------------------------------------------------------

"$poise" curve - --json > "$work/curve.json" << 'END'
poise: 1
dimension: 2
name: an ellipse in three fingers, of which c presses with 5 N at most
length_unit: mm
object: {weight: 4, com: [10, 0], shape: {ellipse: {radii: [50, 30]}}}
contacts:
  - {position: [43.30127, -15], friction: 0.6, finger: a}
  - {position: [-43.30127, -15], friction: 0.5, finger: b}
  - {position: [-28.67882, 24.57456], friction: 0.5, max_normal: 5, finger: c}
END
{
  echo '$arcs << end'  # one after the other: angle, force norm
  jq -r '.arcs[] | [.from_deg, .to_deg, .V.c0, .V.cos1, .V.sin1, .V.cos2, .V.sin2] | @tsv' "$work/curve.json" |
    awk '{
      for (i = 0; i <= 90; i++) {
        deg = $1 + ($2 - $1) * i / 90; x = deg * atan2(0, -1) / 180
        print deg, sqrt($3 + $4 * cos(x) + $5 * sin(x) + $6 * cos(2 * x) + $7 * sin(2 * x))
      }
      print "\n"
    }'
  echo end
  echo '$states << end'
  jq -r '.arcs[] | .from_deg as $f | .to_deg as $t | .states | to_entries[] |
    [.key, $f, $t, .value.state] | @tsv' "$work/curve.json"
  echo end
  echo '$optima << end'
  jq -r '.optima[] | [.angle_deg, .force_norm, .kind, .type] | @tsv' "$work/curve.json"
  echo end
  jq -r '"count=\(.arcs | length); from=\(.holdable_arcs_deg[0][0]); to=\(.holdable_arcs_deg[0][1])"' \
    "$work/curve.json"
  cat << 'END'
set border 3 lc rgb line; set tics nomirror textcolor rgb line
set xtics -180,45,180 format '%g°'
set ytics 0,2,10
set ylabel 'force norm √V [N]' textcolor rgb 'black'
set label 90 'cannot be held' at -151.5,5.4 center rotate by 90 front
set label 91 'cannot be held' at 157,5.4 center rotate by 90 front
set object 90 rectangle from -180,0 to from,10 fc rgb unholdable fs solid 1 noborder behind
set object 91 rectangle from to,0 to 180,10 fc rgb unholdable fs solid 1 noborder behind
set multiplot
set lmargin at screen 0.1; set rmargin at screen 0.98
set tmargin at screen 0.97; set bmargin at screen 0.5
set key at screen 0.36,0.945 left top Left reverse samplen 1.5 spacing 1.15 opaque
# Neighbouring arcs in two tints of one colour.
tint(k) = k % 2 ? 0x0b5394 : 0x6fa8dc
do for [k=1:count] {
  stats $arcs using 1 index k-1 nooutput
  if (k > 1) { set arrow k from STATS_min,graph 0 to STATS_min,graph 1 nohead lw 1 lc rgb '#bbbbbb' back }
  set label 100+k sprintf('%d', k) at (STATS_min+STATS_max)/2,0.5 center front textcolor rgb line
}
set xrange [-180:180]; set yrange [0:10]
is(kind, want, x) = strcol(kind) eq want ? x : NaN
plot for [k=0:count-1] $arcs index k using 1:2 with lines lw 3.5 lc rgb tint(k) notitle, \
  $optima using 1:(strcol(4) eq 'min' ? is(3, 'kink', $2) : NaN) with points pt 13 ps 1.5 lc rgb 'black' title 'minimum: kink', \
  $optima using 1:(strcol(4) eq 'min' ? is(3, 'smooth', $2) : NaN) with points pt 7 ps 1.3 lc rgb 'black' title 'minimum: smooth', \
  $optima using 1:(strcol(4) eq 'max' ? is(3, 'smooth', $2) : NaN) with points pt 6 ps 1.3 lw 1.5 lc rgb 'black' title 'maximum: smooth', \
  $optima using 1:(strcol(4) eq 'max' ? is(3, 'boundary', $2) : NaN) with points pt 4 ps 1.3 lw 1.5 lc rgb 'black' title 'maximum: boundary'

# What each contact does.
do for [k=1:count] { unset label 100+k }
unset arrow
unset label 90; unset label 91
set tmargin at screen 0.4; set bmargin at screen 0.2
set yrange [-0.6:2.6] reverse
set ytics ('contact a' 0, 'contact b' 1, 'contact c' 2) scale 0 textcolor rgb 'black'
unset ylabel
set border 1
set object 90 rectangle from -180,-0.6 to from,2.6
set object 91 rectangle from to,-0.6 to 180,2.6
set xlabel 'object turned counter-clockwise by θ'
set style fill solid 1 noborder
state(name) = strcol(4) eq name ? 1 : NaN
set key at screen 0.54,0.05 center center horizontal width 1 samplen 1.5
plot $states using (state('sticking')*($2+$3)/2):1:2:3:($1-0.32):($1+0.32) with boxxyerror lc rgb cone title 'sticking', \
  $states using (state('slipping')*($2+$3)/2):1:2:3:($1-0.32):($1+0.32) with boxxyerror lc rgb limit title 'slipping', \
  $states using (state('unloaded')*($2+$3)/2):1:2:3:($1-0.32):($1+0.32) with boxxyerror fs solid 1 border rgb line lc rgb 'white' title 'unloaded'
END
} | picture posture-curve 1100 640

# ---- The dual function along a Newton step -----------------------------------------------------

# The hexagon of examples/, in newtons and metres about its com, at -100 degrees from the y of -60.
"$poise" hold "$examples/hexagon-three-fingers.yaml" --angle -60 --json | jq -r '.dual | @tsv' > "$work/y"
"$poise" hold "$examples/hexagon-three-fingers.yaml" --angle -100 --json | jq -r '.effort' > "$work/V"
awk -v yfile="$work/y" -v table="$work/line" '
function projected(zn, zt, lo, hi,   side, c, n) {  # sets fn, ft and the face
  side = zt < 0 ? -1 : 1
  c = zn < lo ? lo : zn > hi ? hi : zn
  if (side * zt < mu * c) { fn = c; ft = zt; edge = 0; n = zn }
  else {
    n = (zn + mu * side * zt) / (1 + mu * mu)
    fn = n < lo ? lo : n > hi ? hi : n
    ft = side * mu * fn; edge = side
  }
  free = n > lo && n < hi
}
# phi, w - G f, and M of the twist y.
function evaluate(   i, p, q, zn, zt, P11, P12, P22) {
  phi = 0; faces = ""
  for (p = 1; p <= 3; p++) { r[p] = w[p]; for (q = 1; q <= 3; q++) M[p, q] = 0 }
  for (i = 1; i <= 3; i++) {
    zn = zt = 0
    for (p = 1; p <= 3; p++) { zn += G[p, i, 1] * y[p]; zt += G[p, i, 2] * y[p] }
    projected(zn, zt, 1, i == 3 ? 5 : 1e300)
    phi += zn * fn + zt * ft - (fn * fn + ft * ft) / 2
    faces = faces edge free " "
    if (edge) { P11 = free / (1 + mu * mu); P12 = edge * mu * P11; P22 = mu * mu * P11 }
    else { P11 = free; P12 = 0; P22 = 1 }
    for (p = 1; p <= 3; p++) {
      r[p] -= G[p, i, 1] * fn + G[p, i, 2] * ft
      for (q = 1; q <= 3; q++)
        M[p, q] += P11 * G[p, i, 1] * G[q, i, 1] + P22 * G[p, i, 2] * G[q, i, 2] \
                 + P12 * (G[p, i, 1] * G[q, i, 2] + G[p, i, 2] * G[q, i, 1])
    }
  }
  value = y[1] * w[1] + y[2] * w[2] + y[3] * w[3] - phi
}
function det(a, b, c, d, e, f, g, h, k) { return a * (e * k - f * h) - b * (d * k - f * g) + c * (d * h - e * g) }
BEGIN {
  mu = 0.5; pi = atan2(0, -1)
  split("30 -30 0", px); split("17.32050807568877 17.32050807568877 -34.64101615137754", py)
  split("-0.8660254037844386 0.8660254037844386 0", nx); split("-0.5 -0.5 1", ny)
  for (i = 1; i <= 3; i++) {
    x = px[i] / 1000; z = py[i] / 1000
    G[1, i, 1] = nx[i]; G[2, i, 1] = ny[i]; G[3, i, 1] = x * ny[i] - z * nx[i]
    G[1, i, 2] = -ny[i]; G[2, i, 2] = nx[i]; G[3, i, 2] = x * nx[i] + z * ny[i]
  }
  W = 0.8 * 9.80665; theta = -100 * pi / 180
  w[1] = W * sin(theta); w[2] = W * cos(theta); w[3] = 0.004 * w[2] - 0.002 * w[1]
  getline text < yfile; split(text, y0)
  for (p = 1; p <= 3; p++) y[p] = y0[p]
  evaluate()
  D = det(M[1,1], M[1,2], M[1,3], M[2,1], M[2,2], M[2,3], M[3,1], M[3,2], M[3,3])
  d[1] = det(r[1], M[1,2], M[1,3], r[2], M[2,2], M[2,3], r[3], M[3,2], M[3,3]) / D
  d[2] = det(M[1,1], r[1], M[1,3], M[2,1], r[2], M[2,3], M[3,1], r[3], M[3,3]) / D
  d[3] = det(M[1,1], M[1,2], r[1], M[2,1], M[2,2], r[2], M[3,1], M[3,2], r[3]) / D
  value0 = value
  slope0 = r[1] * d[1] + r[2] * d[2] + r[3] * d[3]
  for (k = -60; k <= 260; k++) {
    a = k / 200
    for (p = 1; p <= 3; p++) y[p] = y0[p] + a * d[p]
    evaluate()
    slope = r[1] * d[1] + r[2] * d[2] + r[3] * d[3]
    model = a * slope0 - a * a * slope0 / 2
    print a, 2 * value, 2 * slope, faces == before || k == -60 ? "-" : "x", 2 * (value0 + model) > table
    if (slope <= 0 && last > 0) top = a - 1 / 200 * slope / (slope - last)
    last = slope
    before = faces
  }
  printf "top=%.6g\n", top > table ".top"
}'
{
  cat "$work/line.top"
  echo "V=$(cat "$work/V")"
  echo '$l << end'
  cat "$work/line"
  echo end
  cat << 'END'
set border 3 lc rgb line; set tics nomirror textcolor rgb line
set xrange [-0.1:1.1]
set multiplot
set lmargin at screen 0.1; set rmargin at screen 0.97
set tmargin at screen 0.96; set bmargin at screen 0.47
set key left bottom Left reverse samplen 2 spacing 1.15
set yrange [-150:130]; set ytics 50
set xtics format ''
set ylabel '2 (y^T w − φ(G^T y))  [N²]' textcolor rgb 'black'
set arrow 1 from top,graph 0 to top,graph 1 nohead lw 1 lc rgb '#bbbbbb' back
plot V with lines dt 2 lw 1.5 lc rgb best title 'effort V', \
  $l using 1:2 with lines lw 3 lc rgb force title 'the bound', \
  $l using 1:5 with lines dt 4 lw 1.5 lc rgb weight title 'model at a = 0', \
  $l using 1:(strcol(4) eq 'x' ? $2 : NaN) with points pt 7 ps 0.7 lc rgb 'black' title 'a contact changes face'
set tmargin at screen 0.41; set bmargin at screen 0.14
set yrange [-500:250]; set ytics 250
set xtics format '%g'
set ylabel 'its slope [N²]'
set xlabel 'step a along the Newton direction Δy'
set label 1 'where the slope vanishes' at top,graph 0.88 offset 0.8,0
set xzeroaxis lw 1 lc rgb line
plot $l using 1:3 with lines lw 3 lc rgb force notitle, \
  $l using 1:(strcol(4) eq 'x' ? $3 : NaN) with points pt 7 ps 0.7 lc rgb 'black' notitle
END
} | picture dual 1000 620

# ---- Two contacts: one internal force, clamped -------------------------------------------------

picture two-contacts 1000 460 << 'END'
phi = 75 * pi / 180; W = 10.
s = sin(phi); c = cos(phi)
mu_1 = 1.; mu_2 = 1 / sqrt(3)
set angles degrees
# Least-norm forces of the disk (both contacts inside their cones), about the com: v = (vx, vy),
# omega = v' (com - midpoint of the contacts) ... in the frame of the contacts.
# z_n = -p.v, z_t = p_y v_x - p_x v_y - omega, with p_1 = (s, c), p_2 = (-s, c); f_T = z.
# G G^T y = w:  2 vx - 2 c omega = W sin, 2 vy = W cos, -2 c vx + 2 omega = 0.
vx(th) = W * sin(th) / 2 / (1 - c**2)
vy(th) = W * cos(th) / 2
om(th) = c * vx(th)
n1(th) = -s * vx(th) - c * vy(th); t1(th) = c * vx(th) - s * vy(th) - om(th)
n2(th) = s * vx(th) - c * vy(th);  t2(th) = c * vx(th) + s * vy(th) - om(th)
# The internal force: one newton along the line between the contacts, divided by sqrt 2.
# On contact 1 it points along -x: n = s, t = -c; on contact 2 along +x: n = s, t = c.
dn = s / sqrt(2); dt1 = -c / sqrt(2); dt2 = c / sqrt(2)
# alpha from mu n -+ t >= 0; the rates are positive here (force closure), so all are lower bounds.
b(n, t, rn, rt, mu, sign) = -(mu * n + sign * t) / (mu * rn + sign * rt)
b1(th) = b(n1(th), t1(th), dn, dt1, mu_1, 1);  b2(th) = b(n1(th), t1(th), dn, dt1, mu_1, -1)
b3(th) = b(n2(th), t2(th), dn, dt2, mu_2, 1);  b4(th) = b(n2(th), t2(th), dn, dt2, mu_2, -1)
max(x, y) = x > y ? x : y
least(th) = max(max(b1(th), b2(th)), max(b3(th), b4(th)))
set samples 361
set border 3 lc rgb line; set tics nomirror textcolor rgb line
set xrange [-180:180]; set yrange [-20:32]
set xtics -180,45,180 format '%g°'
set ytics -20,10
set lmargin at screen 0.09; set rmargin at screen 0.97
set tmargin at screen 0.96; set bmargin at screen 0.31
set xlabel 'object turned counter-clockwise by θ'
set ylabel 'internal force α [N]' textcolor rgb 'black'
set key at screen 0.53,0.07 center center horizontal Left reverse width 1 samplen 2 maxrows 2
set xzeroaxis lw 1 lc rgb line
plot '+' using 1:(least($1)):(32) with filledcurves lc rgb cone title 'both forces in their cones', \
  b1(x) with lines dt 2 lw 1.2 lc rgb line title 'edges of the right contact', b2(x) with lines dt 2 lw 1.2 lc rgb line notitle, \
  b3(x) with lines dt 4 lw 1.2 lc rgb limit title 'edges of the left contact', b4(x) with lines dt 4 lw 1.2 lc rgb limit notitle, \
  max(0, least(x)) with lines lw 3 lc rgb force title 'α* = 0, clamped to them'
END

# ---- The body C and its cuts -------------------------------------------------------------------

grep -v '^tilt' "$examples/box-three-fingers.yaml" > "$work/box.yaml"
{ echo '$body << end'; /usr/bin/python3 body.py "$poise" "$work/box.yaml" 8 16; echo end; cat << 'END'; } | picture body 940 380
stats $body index 1 using (sqrt($1**2 + $2**2)) nooutput
farthest = STATS_max
unset key; unset border; unset tics
set size ratio -1
set xrange [-1.1:1.55]; set yrange [-0.95:1.0]
set style fill solid 1
set parametric; set trange [-0.75:0.4]
set multiplot layout 1,2 margins 0.01,0.99,0.01,0.9 spacing 0.02
do for [k=2:3] {
  set title sprintf("after %d holds", k == 2 ? 8 : 16) offset 0,-0.7
  set label 1 "C" at -0.3,0.15 center front tc rgb force
  set label 2 "best posture" at 0.6,-0.09 center rotate by -17.5 front tc rgb best
  set label 3 "polytope of the cuts" at -1.05,0.85 left front tc rgb limit
  plot $body index 0 with filledcurves closed fc rgb cone, \
    $body index 0 with lines lc rgb force lw 1.5, \
    farthest * cos(t), farthest * sin(t) with lines lc rgb line dt 2, \
    $body index k with lines lc rgb limit lw 2, \
    $body index 1 using (0):(0):1:2 with vectors head filled size graph 0.03,18 lc rgb best lw 2
}
unset multiplot
END

# ---- The paper ---------------------------------------------------------------------------------

"$(dirname "$poise")/paper" --out "$work/paper" > /dev/null
for figure in figure-{2,3a,3b,3c,4a,4c,5,6,7} equal-frictions when-b-is-a-minimum sampling; do
  mv "$work/paper/$figure.svg" "paper-$figure.svg"
  echo "paper-$figure.svg"
done
