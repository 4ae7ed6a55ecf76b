// Numbers of surface patterns that shaders refer to by name, written in the subset of GLSL that C++ accepts:
// runtime/tools/render/materials.cpp checks that they equal those of SurfacePattern.
const uint kRock = 0u;
const uint kBrick = 4u;
const uint kAshlar = 5u;
const uint kRubble = 6u;
const uint kPaving = 7u;
const uint kCobbles = 8u;
const uint kRoofTiles = 9u;
const uint kSlates = 10u;
const uint kPlain = 11u;
const uint kConcrete = 12u;
const uint kWooden = 13u;
const uint kAsphalt = 15u;
const uint kGlass = 16u;
const uint kLeafy = 20u;
const uint kBoards = 25u;
const uint kGlowing = 26u;
const uint kLying = 27u;
const uint kLava = 28u;
const uint kLeaded = 29u;
// The kinds of rooms behind a window pane: see runtime/tools/materials/material.h.
const uint kClearPane = 1u;
const uint kShopBehind = 2u;
const uint kOfficeBehind = 3u;
const uint kCurtainBehind = 4u;
const uint kBlindBehind = 5u;
