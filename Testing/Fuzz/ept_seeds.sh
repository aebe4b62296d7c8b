#!/bin/sh
# ept_seeds.sh TREE NODE POINTS FOLDER: seeds of FuzzEPTTree: description, page of the hierarchy and
# one node, each behind a line "----". One of TREE, whose nodes are binary; one of NODE, a LAZ file
# of so many POINTS.
set -eu
{
  cat "$1/ept.json"
  printf '\n----\n{"0-0-0-0": 1, "1-0-0-0": 1}\n----\n'
  cat "$1/ept-data/0-0-0-0.bin"
} > "$4/binary"
{
  printf '{"bounds": [-1e7, -1e7, -1e7, 1e7, 1e7, 1e7], "dataType": "laszip", "points": %s, ' "$3"
  printf '"hierarchyType": "json", "span": 128, "version": "1.1.0", "schema": ['
  printf '{"name": "X", "size": 4, "type": "signed"}, {"name": "Y", "size": 4, "type": "signed"}, '
  printf '{"name": "Z", "size": 4, "type": "signed"}]}'
  printf '\n----\n{"0-0-0-0": %s, "1-1-1-1": 0}\n----\n' "$3"
  cat "$2"
} > "$4/laszip"
