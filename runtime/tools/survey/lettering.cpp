#include "tools/survey/lettering.h"

#include <algorithm>
#include <array>

namespace sgm::survey {
namespace {

// The Hershey Fonts were originally created by Dr. A. V. Hershey while working at the U. S. National Bureau of
// Standards. The format of the Font data in this distribution was originally created by James Hurt, Cognition, Inc.,
// 900 Technology Park Drive, Billerica, MA 01821 (mit-eddie!ci-dandelion!hurt).
//
// The font is Roman simplex, one string for each ASCII character from the space on. Each coordinate is a letter, and
// 'R' stands for 0. A string begins with the left and right ends of its glyph; then follow the points (x, y) of its
// strokes, y down. A space followed by 'R' lifts the pen.
constexpr std::array<std::string_view, 95> kGlyphs{{
    R"(JZ)",
    R"(MWRFRT RRYQZR[SZRY)",
    R"(JZNFNM RVFVM)",
    R"(H]SBLb RYBRb RLOZO RKUYU)",
    R"(H\PBP_ RTBT_ RYIWGTFPFMGKIKKLMMNOOUQWRXSYUYXWZT[P[MZKX)",
    R"(F^[FI[ RNFPHPJOLMMKMIKIIJGLFNFPGSHVHYG[F RWTUUTWTYV[X[ZZ[X[VYTWT)",
    R"(E_\O\N[MZMYNXPVUTXRZP[L[JZIYHWHUISJRQNRMSKSIRGPFNGMIMKNNPQUXWZY[[[\Z\Y)",
    R"(MWRHQGRFSGSIRKQL)",
    R"(KYVBTDRGPKOPOTPYR]T`Vb)",
    R"(KYNBPDRGTKUPUTTYR]P`Nb)",
    R"(JZRFRR RMIWO RWIMO)",
    R"(E_RIR[ RIR[R)",
    R"(MWSZR[QZRYSZS\R^Q_)",
    R"(E_IR[R)",
    R"(MWRYQZR[SZRY)",
    R"(G][BIb)",
    R"(H\QFNGLJKOKRLWNZQ[S[VZXWYRYOXJVGSFQF)",
    R"(H\NJPISFS[)",
    R"(H\LKLJMHNGPFTFVGWHXJXLWNUQK[Y[)",
    R"(H\MFXFRNUNWOXPYSYUXXVZS[P[MZLYKW)",
    R"(H\UFKTZT RUFU[)",
    R"(H\WFMFLOMNPMSMVNXPYSYUXXVZS[P[MZLYKW)",
    R"(H\XIWGTFRFOGMJLOLTMXOZR[S[VZXXYUYTXQVOSNRNOOMQLT)",
    R"(H\YFO[ RKFYF)",
    R"(H\PFMGLILKMMONSOVPXRYTYWXYWZT[P[MZLYKWKTLRNPQOUNWMXKXIWGTFPF)",
    R"(H\XMWPURRSQSNRLPKMKLLINGQFRFUGWIXMXRWWUZR[P[MZLX)",
    R"(MWRMQNROSNRM RRYQZR[SZRY)",
    R"(MWRMQNROSNRM RSZR[QZRYSZS\R^Q_)",
    R"(F^ZIJRZ[)",
    R"(E_IO[O RIU[U)",
    R"(F^JIZRJ[)",
    R"(I[LKLJMHNGPFTFVGWHXJXLWNVORQRT RRYQZR[SZRY)",
    R"(E`WNVLTKQKOLNMMPMSNUPVSVUUVS RQKOMNPNSOUPV RWKVSVUXVZV\T]Q]O\L[JYHWGTFQFNGLHJJILHOHRIUJWLYNZQ[T[WZYYZX RXKWSWUXV)",
    R"(I[RFJ[ RRFZ[ RMTWT)",
    R"(G\KFK[ RKFTFWGXHYJYLXNWOTP RKPTPWQXRYTYWXYWZT[K[)",
    R"(H]ZKYIWGUFQFOGMILKKNKSLVMXOZQ[U[WZYXZV)",
    R"(G\KFK[ RKFRFUGWIXKYNYSXVWXUZR[K[)",
    R"(H[LFL[ RLFYF RLPTP RL[Y[)",
    R"(HZLFL[ RLFYF RLPTP)",
    R"(H]ZKYIWGUFQFOGMILKKNKSLVMXOZQ[U[WZYXZVZS RUSZS)",
    R"(G]KFK[ RYFY[ RKPYP)",
    R"(NVRFR[)",
    R"(JZVFVVUYTZR[P[NZMYLVLT)",
    R"(G\KFK[ RYFKT RPOY[)",
    R"(HYLFL[ RL[X[)",
    R"(F^JFJ[ RJFR[ RZFR[ RZFZ[)",
    R"(G]KFK[ RKFY[ RYFY[)",
    R"(G]PFNGLIKKJNJSKVLXNZP[T[VZXXYVZSZNYKXIVGTFPF)",
    R"(G\KFK[ RKFTFWGXHYJYMXOWPTQKQ)",
    R"(G]PFNGLIKKJNJSKVLXNZP[T[VZXXYVZSZNYKXIVGTFPF RSWY])",
    R"(G\KFK[ RKFTFWGXHYJYLXNWOTPKP RRPY[)",
    R"(H\YIWGTFPFMGKIKKLMMNOOUQWRXSYUYXWZT[P[MZKX)",
    R"(JZRFR[ RKFYF)",
    R"(G]KFKULXNZQ[S[VZXXYUYF)",
    R"(I[JFR[ RZFR[)",
    R"(F^HFM[ RRFM[ RRFW[ R\FW[)",
    R"(H\KFY[ RYFK[)",
    R"(I[JFRPR[ RZFRP)",
    R"(H\YFK[ RKFYF RK[Y[)",
    R"(KYOBOb RPBPb ROBVB RObVb)",
    R"(KYKFY^)",
    R"(KYTBTb RUBUb RNBUB RNbUb)",
    R"(JZPLRITL RMORJWO RRJR[)",
    R"(JZJ]Z])",
    R"(MWSFRGQIQKRLSKRJ)",
    R"(I\XMX[ RXPVNTMQMONMPLSLUMXOZQ[T[VZXX)",
    R"(H[LFL[ RLPNNPMSMUNWPXSXUWXUZS[P[NZLX)",
    R"(I[XPVNTMQMONMPLSLUMXOZQ[T[VZXX)",
    R"(I\XFX[ RXPVNTMQMONMPLSLUMXOZQ[T[VZXX)",
    R"(I[LSXSXQWOVNTMQMONMPLSLUMXOZQ[T[VZXX)",
    R"(MYWFUFSGRJR[ ROMVM)",
    R"(I\XMX]W`VaTbQbOa RXPVNTMQMONMPLSLUMXOZQ[T[VZXX)",
    R"(I\MFM[ RMQPNRMUMWNXQX[)",
    R"(NVQFRGSFREQF RRMR[)",
    R"(MWRFSGTFSERF RSMS^RaPbNb)",
    R"(IZMFM[ RWMMW RQSX[)",
    R"(NVRFR[)",
    R"(CaGMG[ RGQJNLMOMQNRQR[ RRQUNWMZM\N]Q][)",
    R"(I\MMM[ RMQPNRMUMWNXQX[)",
    R"(I\QMONMPLSLUMXOZQ[T[VZXXYUYSXPVNTMQM)",
    R"(H[LMLb RLPNNPMSMUNWPXSXUWXUZS[P[NZLX)",
    R"(I\XMXb RXPVNTMQMONMPLSLUMXOZQ[T[VZXX)",
    R"(KXOMO[ ROSPPRNTMWM)",
    R"(J[XPWNTMQMNNMPNRPSUTWUXWXXWZT[Q[NZMX)",
    R"(MYRFRWSZU[W[ ROMVM)",
    R"(I\MMMWNZP[S[UZXW RXMX[)",
    R"(JZLMR[ RXMR[)",
    R"(G]JMN[ RRMN[ RRMV[ RZMV[)",
    R"(J[MMX[ RXMM[)",
    R"(JZLMR[ RXMR[P_NaLbKb)",
    R"(J[XMM[ RMMXM RM[X[)",
    R"(KYTBRCQDPFPHQJRKSMSOQQ RRCQEQGRISJTLTNSPORSTTVTXSZR[Q]Q_Ra RQSSUSWRYQZP\P^Q`RaTb)",
    R"(NVRBRb)",
    R"(KYPBRCSDTFTHSJRKQMQOSQ RRCSESGRIQJPLPNQPURQTPVPXQZR[S]S_Ra RSSQUQWRYSZT\T^S`RaPb)",
    R"(F^IUISJPLONOPPTSVTXTZS[Q RISJQLPNPPQTTVUXUZT[Q[O)",
}};

constexpr double kCapital = 21, kBaseline = 9;  // in glyph units: height of capital letters, and y of the baseline

std::string_view glyphFor(char letter) {
  const auto index = static_cast<size_t>(static_cast<unsigned char>(letter)) - 32;
  return kGlyphs[index < kGlyphs.size() ? index : size_t{'?'} - 32];
}

double edge(char letter) { return letter - 'R'; }

/// The text with one character for each code point; a code point beyond ASCII keeps only its first byte.
std::string plain(std::string_view text) {
  std::string out;
  for (const char c : text)
    if ((static_cast<unsigned char>(c) & 0xC0) != 0x80) out += c;
  return out;
}

}  // namespace

double letterWidth(std::string_view text, double height) {
  double width = 0;
  for (const char letter : plain(text)) width += edge(glyphFor(letter)[1]) - edge(glyphFor(letter)[0]);
  return width * height / kCapital;
}

Mark lettering(std::string_view text, Point at, double height, Align align, Ink ink) {
  Mark mark;
  mark.name = "text";
  mark.text = text;
  mark.ink = ink;
  mark.width = std::max(0.8, height / 10);
  const double scale = height / kCapital, width = letterWidth(text, height);
  double x = at.x - (align == Align::right ? width : align == Align::middle ? width / 2 : 0);
  for (const char letter : plain(text)) {
    const std::string_view glyph = glyphFor(letter);
    const double left = edge(glyph[0]);
    Line stroke;
    for (size_t i = 2; i + 1 < glyph.size(); i += 2) {
      if (glyph[i] == ' ') {
        mark.lines.push_back(std::move(stroke));
        stroke.clear();
        continue;
      }
      stroke.push_back({x + scale * (edge(glyph[i]) - left), at.y + scale * (edge(glyph[i + 1]) - kBaseline)});
    }
    if (!stroke.empty()) mark.lines.push_back(std::move(stroke));
    x += scale * (edge(glyph[1]) - left);
  }
  return mark;
}

}  // namespace sgm::survey
