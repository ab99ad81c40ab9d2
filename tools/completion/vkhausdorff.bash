# Completion of vkhausdorff for bash. Made by tools/options/make_pages.py.
_vkhausdorff() {
  local current=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD-1]} command=${COMP_WORDS[1]-} options=
  local commands="distance gate metrics batch merge simplify demo doctor help"
  COMPREPLY=()
  if [ "$COMP_CWORD" = 1 ]; then
    mapfile -t COMPREPLY < <(compgen -W "$commands --help --help-all --version" -- "$current")
    return
  fi
  case $previous in
    --figures) mapfile -t COMPREPLY < <(compgen -W "hausdorff hd_p hd_p_pooled masd assd rms chamfer_l1 chamfer_l2 normal_consistency nsd precision recall f1 precision_normals recall_normals f1_normals" -- "$current"); return ;;
    --polygons) mapfile -t COMPREPLY < <(compgen -W "fan any" -- "$current"); return ;;
    --bodies) mapfile -t COMPREPLY < <(compgen -W "solid all" -- "$current"); return ;;
    --points) mapfile -t COMPREPLY < <(compgen -W "a b both" -- "$current"); return ;;
    --unit) mapfile -t COMPREPLY < <(compgen -W "um mm cm m in ft" -- "$current"); return ;;
    --unit-a) mapfile -t COMPREPLY < <(compgen -W "um mm cm m in ft" -- "$current"); return ;;
    --unit-b) mapfile -t COMPREPLY < <(compgen -W "um mm cm m in ft" -- "$current"); return ;;
    --view) mapfile -t COMPREPLY < <(compgen -W "iso six" -- "$current"); return ;;
    --up) mapfile -t COMPREPLY < <(compgen -W "y z" -- "$current"); return ;;
    --map) mapfile -t COMPREPLY < <(compgen -W "viridis batlow cividis" -- "$current"); return ;;
    --device) mapfile -t COMPREPLY < <(compgen -W "gpu cpu $([[ " distance batch " != *" $command "* ]] || echo all) $([[ " distance gate metrics simplify demo doctor batch " != *" $command "* ]] || echo native)" -- "$current"); return ;;
    --preset) mapfile -t COMPREPLY < <(compgen -W "default paper baseline-gpu" -- "$current"); return ;;
    --enable) mapfile -t COMPREPLY < <(compgen -W "centroid parent_samples tolerance_cull thin u3 u4 warm_start group_walk shared_faces sort packet defer largest_first u3_paper split_twice wide multiwave" -- "$current"); return ;;
    --disable) mapfile -t COMPREPLY < <(compgen -W "centroid parent_samples tolerance_cull thin u3 u4 warm_start group_walk shared_faces sort packet defer largest_first u3_paper split_twice wide multiwave" -- "$current"); return ;;
    --max | --area | --tol | --part | --known-lower | --percentile | --bands | --normals | --max-distance | --field-tol | --effort | --levels | --ratio | --title | --size | --range | --steps | --shard | --together | --lanes | --read-ahead | --max-input | --threads | --time | --memory | --waves) return ;;
  esac
  case $command in
    distance) options="--tol --symmetric --part --known-lower --stats --signed --bands --max-distance --field-tol --effort --polygons --bodies --points --unit --unit-a --unit-b --transform --scale --align --save-transform --field --image --report --title --figures-csv --points-out --certificate --json --verbose --verify --view --up --size --map --range --steps --max-input --device --threads --time --memory --waves --preset --enable --disable --no-cache --help --help-all" ;;
    gate) options="--max --face-max --face-max-b --area --worst --tol --symmetric --stats --signed --bands --max-distance --field-tol --effort --polygons --bodies --points --unit --unit-a --unit-b --transform --scale --align --save-transform --field --image --report --title --figures-csv --points-out --certificate --junit --github --json --verbose --verify --view --up --size --map --range --steps --max-input --device --threads --time --memory --waves --preset --enable --disable --no-cache --help --help-all" ;;
    metrics) options="--tol --percentile --bands --figures --normals --effort --polygons --bodies --points --unit --unit-a --unit-b --transform --scale --align --save-transform --json --verbose --verify --max-input --device --threads --time --memory --waves --preset --enable --disable --no-cache --help --help-all" ;;
    batch) options="--max --tol --symmetric --signed --metrics --percentile --bands --figures --normals --max-distance --effort --polygons --bodies --points --unit --unit-a --unit-b --transform --scale --align --out --csv --junit --github --image-dir --report-dir --view --up --size --map --range --steps --against --allow-unpaired --resume --shard --fail-fast --together --lanes --read-ahead --max-input --device --threads --time --memory --waves --preset --enable --disable --no-cache --help --help-all" ;;
    merge) options="--out --csv --junit --list --reproducible --help --help-all" ;;
    simplify) options="--max --one-way --lock-borders --levels --ratio --polygons --bodies --unit --out --certificate --json --max-input --device --threads --time --memory --waves --preset --enable --disable --no-cache --help --help-all" ;;
    demo) options="--tol --symmetric --stats --signed --bands --max-distance --field-tol --effort --field --image --report --title --figures-csv --points-out --json --verbose --verify --view --up --size --map --range --steps --device --threads --time --memory --waves --preset --enable --disable --no-cache --help --help-all" ;;
    doctor) options="--json --device --help --help-all" ;;
    help) options="$commands" ;;
  esac
  if [[ $current == -* || $command == help ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$options" -- "$current")
  else
    mapfile -t COMPREPLY < <(compgen -f -- "$current")
  fi
}
complete -o filenames -F _vkhausdorff vkhausdorff
