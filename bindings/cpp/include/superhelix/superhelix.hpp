// superhelix for C++17: the whole C interface with owners, views and errors. docs/guide/cpp.md is the guide.
//
// Names are those of superhelix.h without shx_; what its comments say holds here. Link the C library.
#ifndef SUPERHELIX_HPP
#define SUPERHELIX_HPP

#include "attachment.hpp"
#include "curves.hpp"
#include "definitions.hpp"
#include "enumerations.hpp"
#include "fit.hpp"
#include "handle.hpp"
#include "haptic.hpp"
#include "motion.hpp"
#include "render_hair.hpp"
#include "result.hpp"
#include "scalp.hpp"
#include "settings.hpp"
#include "solver.hpp"
#include "span.hpp"
#include "styling.hpp"
#include "types.hpp"

#endif  // SUPERHELIX_HPP
