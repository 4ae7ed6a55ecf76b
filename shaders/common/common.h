// Includes all headers of the functions that evaluate fields, in the order of their dependencies. See portable.h.
#include "portable.h"
#include "real.h"
#include "noise.h"
#include "primitives.h"
#include "lattice.h"
#include "combine.h"
#include "attributes.h"
#include "density.h"
