# Completion of vkhausdorff for bash.
_vkhausdorff() {
  local current=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD-1]} command=${COMP_WORDS[1]-}
  local commands="distance gate metrics batch merge simplify demo doctor help"
  local engine="--memory --waves --preset --enable --disable --no-cache --help --help-all" search tables="--out --csv --junit"
  search="--device --time $engine"
  local look="--view --up --size --map --range --steps"
  local outputs="--json --verbose --verify --tol --symmetric --stats --signed --bands --max-distance --field-tol --effort --field --image --report --title --figures-csv --points-out $look"
  local files="--unit --unit-a --unit-b --transform --scale --align --max-input --polygons --bodies --points"
  local options="--help --help-all --version"
  COMPREPLY=()
  if [ "$COMP_CWORD" = 1 ]; then
    mapfile -t COMPREPLY < <(compgen -W "$commands $options" -- "$current")
    return
  fi
  case $previous in
    --device) mapfile -t COMPREPLY < <(compgen -W "gpu cpu all" -- "$current"); return ;;
    --preset) mapfile -t COMPREPLY < <(compgen -W "default paper baseline-gpu" -- "$current"); return ;;
    --view) mapfile -t COMPREPLY < <(compgen -W "iso six" -- "$current"); return ;;
    --figures) mapfile -t COMPREPLY < <(compgen -W "hausdorff hd_p hd_p_pooled masd assd rms chamfer_l1 chamfer_l2 nsd precision recall f1 normal_consistency precision_normals recall_normals f1_normals" -- "$current"); return ;;
    --up) mapfile -t COMPREPLY < <(compgen -W "y z" -- "$current"); return ;;
    --map) mapfile -t COMPREPLY < <(compgen -W "viridis batlow cividis" -- "$current"); return ;;
    --polygons) mapfile -t COMPREPLY < <(compgen -W "fan any" -- "$current"); return ;;
    --bodies) mapfile -t COMPREPLY < <(compgen -W "solid all" -- "$current"); return ;;
    --points) mapfile -t COMPREPLY < <(compgen -W "a b both" -- "$current"); return ;;
    --unit | --unit-a | --unit-b) mapfile -t COMPREPLY < <(compgen -W "um mm cm m in ft" -- "$current"); return ;;
    --max | --tol | --time | --memory | --waves | --max-input | --enable | --disable | \
      --area | --percentile | --bands | --normals | --max-distance | --field-tol | --effort | --size | --range | --steps | --shard | --together | --lanes | --read-ahead | \
      --part | --known-lower | --levels | --ratio) return ;;
  esac
  case $command in
    distance) options="$search $outputs $files --save-transform --certificate --part --known-lower" ;;
    gate) options="$search $outputs $files --save-transform --certificate --max --worst --area --face-max --face-max-b --junit --github" ;;
    metrics) options="$search $files --save-transform --percentile --bands --figures --normals --tol --effort --json --verbose --verify" ;;
    batch)
      options="$search $tables --against --allow-unpaired --github --resume --shard --fail-fast --max --tol --symmetric --signed --metrics --percentile --bands --figures --normals $files"
      options+=" --image-dir --report-dir --effort --max-distance $look --together --lanes --read-ahead" ;;
    simplify) options="$search --json --max --out --one-way --lock-borders --levels --ratio --certificate --unit --max-input --polygons --bodies" ;;
    merge) options="$tables --list --reproducible --help --help-all" ;;
    demo) options="$search $outputs" ;;
    doctor) options="--device --json --help --help-all" ;;
    help) options="$commands" ;;
  esac
  if [[ $current == -* || $command == help ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$options" -- "$current")
  else
    mapfile -t COMPREPLY < <(compgen -f -- "$current")
  fi
}
complete -o filenames -F _vkhausdorff vkhausdorff
