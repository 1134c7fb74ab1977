#include "mutators.h"

VIEWCELL_FUZZ_MUTATOR(mutate_glb)
