// Five colours of Okabe and Ito, which remain distinct to colour-blind readers, and two greys.
export const COLOURS = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#9a9a9a", "#404040"];
