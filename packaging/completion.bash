# Completion of poise for bash: commands, flags, and the files and words they take.

_poise_files() {  # names that end like this, and directories
  local suffixes=$1
  compopt -o filenames 2> /dev/null
  mapfile -t COMPREPLY < <(
    compgen -d -- "$word"
    shopt -s extglob
    compgen -f -X "!*.@($suffixes)" -- "$word"
  )
}

_poise() {
  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]} command= flags= k
  COMPREPLY=()
  for ((k = 1; k < COMP_CWORD; ++k)); do
    [[ ${COMP_WORDS[k]} == -* ]] || { command=${COMP_WORDS[k]}; break; }
  done

  case $command in
    '') flags='-h --help --version' ;;
    check | verify) flags='-h --help --json' ;;
    hold) flags='-h --help --json --angle --up --force-cap' ;;
    best)
      flags='-h --help --json --domain --force-cap --gap --max-holds --tilt-from --tilt-max
        --orientation'
      ;;
    capacity) flags='-h --help --json --angle --up --safety --force-cap' ;;
    draw) flags='-h --help -o --out --angle --up --force-cap' ;;
    curve) flags='-h --help --json --domain --force-cap --plot' ;;
    contacts) flags='-h --help -o --out' ;;
    import) flags='-h --help --mesh-root --grasp -o --out' ;;
    view) flags='-h --help -o --out' ;;
    paper) flags='-h --help --json --out --phi --mu1 --mu2 --weight' ;;
    *) return ;;
  esac

  case $before in
    --domain) mapfile -t COMPREPLY < <(compgen -W 'all pinched' -- "$word") ;;
    --plot) _poise_files svg ;;
    -o) _poise_files 'html|svg|png|yaml|yml|json' ;;
    --out | --mesh-root)
      compopt -o filenames 2> /dev/null
      mapfile -t COMPREPLY < <(compgen -d -- "$word")
      ;;
    --angle | --up | --safety | --force-cap | --gap | --max-holds | --tilt-from | --tilt-max | --orientation) ;;
    --grasp | --phi | --mu1 | --mu2 | --weight) ;;  # numbers
    *)
      if [[ $word == -* ]]; then
        mapfile -t COMPREPLY < <(compgen -W "$flags" -- "$word")
      elif [[ -z $command ]]; then
        mapfile -t COMPREPLY < <(compgen -W 'check contacts hold best curve capacity draw verify view import paper' -- "$word")
      elif [[ $command == import && $before == import ]]; then
        mapfile -t COMPREPLY < <(compgen -W acronym -- "$word")
      elif [[ $command == import ]]; then
        _poise_files h5
      elif [[ $command != paper ]]; then
        _poise_files 'yaml|yml|json'
      fi
      ;;
  esac
}

complete -F _poise poise
