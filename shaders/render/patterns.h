// The numbers of patterns that shaders ask for by name, in the subset of GLSL that C++ reads too:
// runtime/cli/render/materials.cpp checks them against SurfacePattern.
const uint kBrick = 4u, kAshlar = 5u, kRubble = 6u, kPaving = 7u, kCobbles = 8u, kRoofTiles = 9u, kSlates = 10u;
const uint kPlain = 11u, kConcrete = 12u, kWooden = 13u, kAsphalt = 15u, kLeafy = 20u, kBoards = 25u;
