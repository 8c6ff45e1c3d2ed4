#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# marks.sh FOLDER AMALGAMATION CC CGLM: without the lines between their "glssao" and "end" marks, the dropin programs compile and
# do not mention glssao. With these lines they compile in one call together with the amalgamation.
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
. "$here/../packaging/common.sh"
folder=$1 amalgamation=$2 cc=$3 cglm=$4
mkdir "$scratch/glssao"
cp "$amalgamation"/glssao.[ch] "$scratch/glssao"
cp "$folder"/support.[ch] "$scratch"
cd "$scratch"
for program in dropin legacy; do
    loader=$([ $program = legacy ] && echo DROPIN_LEGACY || echo DROPIN_PROTOTYPES)
    awk '/\/\* glssao/{inside = 1} !inside {print} /\/\* end \*\//{inside = 0}' "$folder/$program.c" >"bare-$program.c"
    awk '/\/\* end \*\//{inside = 0} inside && NF {++n} /\/\* glssao/{inside = 1} END {print n}' "$folder/$program.c" >count
    ! grep glssao_ "bare-$program.c" || fail "$program.c uses glssao outside its marks"
    quietly "$cc" -std=c11 -D$loader -I"$cglm" "bare-$program.c" support.c -lglfw -lGL -lm -o "bare-$program"
    cp "$folder/$program.c" .
    quietly "$cc" -std=c11 -D$loader -I. -I"$cglm" "$program.c" support.c glssao/glssao.c -lglfw -lGL -lm -o "$program"
    echo "$program: $(cat count) lines added to $(grep -c . "bare-$program.c")"
done
