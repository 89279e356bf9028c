// What a search shows first: pages that explain, and the page of a name that is sought; then what names
// take and hold; modules and kernels last.
var Scorer = {
  score: ([page, _title, anchor, _text, score]) => {
    if (page.startsWith("modules/")) return score - 60;
    if (page.startsWith("reference/")) return anchor ? score - 20 : score + 10;
    if (page.startsWith("question-") && !anchor) return score + 12;
    return score;
  },
  objNameMatch: 11,
  objPartialMatch: 6,
  objPrio: { 0: 15, 1: 5, 2: -5 },
  objPrioDefault: 0,
  title: 15,
  partialTitle: 7,
  term: 5,
  partialTerm: 2,
};
