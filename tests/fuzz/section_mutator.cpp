#include "mutators.h"

VIEWCELL_FUZZ_MUTATOR(mutate_sections)
