/** `eigenbody check` over all that the joint limits allow. */

import type { Check, CheckFinding } from "../api/types";
import { button, h, write } from "../dom";
import type { Explorer } from "../explorer";
import { shown } from "../math/number";

const NAMES = { kappa: "κ", kappa_weighted: "κ′", lambda_min: "λmin" };

const RUN = "Check all that the joint limits allow";

export function check(explorer: Explorer, found: (findings: CheckFinding[]) => void): HTMLElement {
  const status = h("p", { class: "small soft", role: "status" });
  const worst = h("div", { class: "scroll" });
  const run = button(RUN, () => (running ? running.abort() : void go()));
  let running: AbortController | null = null;
  const go = async () => {
    const { model } = explorer;
    if (!model) return;
    const { signal } = (running = new AbortController());
    write(run, "Cancel the check");
    write(status, "Searching for the worst configurations…");
    await explorer.attempt(async () => {
      const report = await explorer.client.check(model.id, explorer.state.metric, signal).catch((error: unknown) => {
        if (signal.aborted) return null;
        throw error;
      });
      if (report) show(report);
      else if (explorer.model?.id === model.id) write(status, "Cancelled.");
    });
    running = null;
    write(run, RUN);
    if (status.textContent?.endsWith("…")) write(status, "");
  };
  const show = (report: Check) => {
    const count = report.findings.length;
    status.textContent = `${report.evaluations} configurations; ${count === 0 ? "nothing wrong" : count === 1 ? "1 finding, below" : `${count} findings, below`}.`;
    const rows = report.worst.map(({ measure, worst: x, median, q }) =>
      h("tr", {}, h("th", { scope: "row" }, NAMES[measure]), h("td", {}, shown(x)), h("td", {}, shown(median)),
        h("td", {}, q.length > 0 && button("Go there", () => explorer.pose(q), { "aria-label": `Go to the worst ${NAMES[measure]}` }))));
    worst.replaceChildren(h("table", {}, h("caption", {}, "Over the joint limits"),
      h("thead", {}, h("tr", {}, ...["measure", "worst", "median", "where"].map((text) => h("th", { scope: "col" }, text)))), h("tbody", {}, ...rows)));
    found(report.findings);
  };
  explorer.on("model", () => {
    running?.abort();
    status.textContent = "";
    worst.replaceChildren();
    found([]);
  });
  return h("section", { class: "block", "aria-label": "Check" }, h("h2", {}, "What is the worst it can get?"), h("div", { class: "row" }, run, status), worst);
}
