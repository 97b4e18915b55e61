#!/bin/sh
# Solves the NAFEMS cylinder and the fzg-c pair with CalculiX, with sharp tips and with rounded ones that touch, a plastic, an
# undercut and an internal pair, and pinion teeth in space, writes the results beside this file and prints those of the first two beside
# gearwear's. Needs Python 3.10, ccx (or CCX=…) and gearwear (or GEARWEAR=…); about an hour and a half.
set -eu
here=$(dirname "$0")
for program in "${CCX:-ccx}" "${GEARWEAR:-gearwear}"; do
    command -v "$program" >/dev/null || { echo "$program is not on the PATH; see README.md" >&2; exit 2; }
done
export PYTHONDONTWRITEBYTECODE=1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
python3 "$here"/nafems_cylinder.py "$work"
python3 "$here"/fzg_c_pair.py "$work"
python3 "$here"/tip_edges.py "$work"
python3 "$here"/plastic_pair.py "$work"
python3 "$here"/undercut_pair.py "$work"
python3 "$here"/internal_pair.py "$work"
python3 "$here"/teeth_in_space.py "$work"
python3 "$here"/compare.py "$work"
