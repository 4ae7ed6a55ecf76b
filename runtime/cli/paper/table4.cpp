#include "cli/paper/table4.h"

namespace sgm::cli {
namespace {

constexpr const char* kNone = "Does not apply";

constexpr ComparedSystem kSystems[] = {
    {"Greuter's method",
     {"NO", "YES", "NO", "YES (P)", "YES (Extrusion)", "YES", "YES", "NO", "NO DATA", "YES"},
     "table4/greuter.sgm", "-128,0,-128:0,160,0", 1, 2, "tall=40", nullptr,
     "-160,0,-560:160,150,-230", "1,70,-225:0,40,-400", 1, 2, 0, nullptr, true,
     "An endless city of towers",
     "The grammar makes cities alone. It has no morphing, which the method's own paper does not describe either; in this "
     "language every rule may have it. Hidden surfaces are not there: towers are one solid with what stands in them."},
    {"Voxel method",
     {"NO", "NO", "YES", "YES (SZ)", "YES (Voxels)", "NO", "NO", "YES", "NO", "YES"},
     "table4/voxel.sgm", "0,0,0:64,64,64", 0.5, 1, "rock=55%", nullptr,
     "-64,0,-64:0,64,0", "", 0.5, 1, 5, nullptr, false,
     "A cave of a cellular automaton",
     "The grammar makes caves alone. Texture coordinates come with every mesh, and vertices are shared by exact keys."},
    {"Cui's method",
     {"NO", "NO", "YES", "YES (S)", "YES (Voxels)", "NO", "NO", "NO", "NO", "NO"},
     "table4/cui.sgm", "0,0,0:96,96,96", 0.5, 1, "long=1m", "square=1",
     "0,0,0:96,96,96", "", 0.25, 0.5, 1, nullptr, false,
     "A cave with stalactites",
     "The grammar makes caves alone. Its halls morph from round to square; the mesh has shared vertices, no hidden "
     "surface and no hole, all of which the paper denies the method."},
    {"Birger's method",
     {"YES", "NO", "NO", "YES (SZ)", "YES (Noise)", "NO", "YES", kNone, kNone, kNone},
     "table4/birger.sgm", "0,700,0:800,1100,800", 8, 16, "cover=80%", nullptr,
     "0,600,0:2560,1200,2560", "1280,1075,2500:1280,850,900", 10, 20, 0, nullptr, false,
     "A deck of noise clouds from above",
     "The grammar makes clouds alone, without morphing. As meshes they are closed; as fog there is nothing to close."},
    {"Marson's method",
     {"NO", "YES", "NO", "YES (P)", "YES (Tree map)", "NO", "NO", "NO", "YES", "YES"},
     "table4/marson.sgm", "", 0.1, 0.2, "living=50", nullptr,
     "", "4,19,14:0.5,0,0.5", 0.1, 0.2, 0, "roofed=0", false,
     "A house's floor of rooms from above, without its roof",
     "The grammar makes houses alone, without morphing. Texture coordinates come with every mesh, and walls are one "
     "solid, so that none hides in another."},
    {"Lipp's method",
     {"NO", "YES", "NO", "YES(P)", "YES (Shape grammar)", "NO", "YES", "YES", "NO DATA", "YES"},
     "table4/lipp.sgm", "", 0.2, 0.4, "floors=5", nullptr,
     "", "", 0.15, 0.25, 0, nullptr, true,
     "A palace with a gate and a balcony that were edited by hand",
     "The grammar makes palaces alone, without morphing."},
    {"Cabral's method",
     {"NO", "YES", "NO", "YES(P)", "YES (Edge and texture transformation)", "NO", "YES", "NO DATA", "YES", "YES"},
     "table4/cabral.sgm", "", 0.25, 0.5, "long=80m", nullptr,
     "", "", 0.2, 0.3, 0, nullptr, true,
     "A street of two assets in many sizes",
     "The grammar makes streets alone, without morphing."},
    {"Bouthor's method",
     {"YES", "NO", "NO", "YES(SZ)", "YES (Anisotropic diffusion)", "NO", "YES", "N/O", kNone, kNone},
     "table4/bouthors.sgm", "0,640,0:800,1280,800", 6, 12, "levels=1", "wide=1",
     "", "", 4, 8, 0, nullptr, false,
     "A cumulus of blobs upon blobs",
     "The grammar makes clouds alone. Its blobs morph from round to wide."},
    {"Mullera's method",
     {"NO", "YES", "NO", "YES(P)", "YES (Shape grammar)", "NO", "NO", "YES", "YES", "YES"},
     "table4/muller.sgm", "", 0.2, 0.4, "floors=4", nullptr,
     "", "", 0.15, 0.25, 0, nullptr, true,
     "An office tower with balconies",
     "The grammar makes towers alone, without morphing. Texture coordinates come with every mesh."},
    {"System GK-M",
     {"YES", "YES", "YES", "YES (S)", "YES (Shape grammar, morphing, CSG)", "YES", "NO", "YES", "YES", "YES"},
     "table4/gkm.sgm", "-96,-64,-96:96,128,96", 1, 2, "floors=8", "round=0",
     "-128,-64,-128:128,160,128", "120,6,330:0,26,0", 1, 2, 0, nullptr, false,
     "Caves under ground, towers on it and clouds above",
     "Texture mapping, the paper's own NO, is there."},
};

}  // namespace

std::span<const ComparedSystem> comparedSystems() { return kSystems; }

}  // namespace sgm::cli
