// The eight procedural figures, each in its own file. Units and rough size are those of Table 5.2;
// the front looks along -y (of the animals that lie along x: along +x).
#pragma once

#include "park/implicit.h"

namespace viewcell {

Figure make_dragon_figure();  ///< a serpent dragon, scaled, horned, arched over its legs
Figure make_hare_figure();    ///< a sitting hare on a mound
Figure make_robed_figure();   ///< a robed walker with staff and lantern, on a plinth
Figure make_cattle_figure();  ///< a bull and a lying calf
Figure make_horse_figure();   ///< a rearing horse on a tall plinth
Figure make_moai_figure();    ///< a long-eared stone head with a topknot
Figure make_camel_figure();   ///< a camel of two humps
Figure make_bust_figure();    ///< a woman's bust on a socle

}  // namespace viewcell
