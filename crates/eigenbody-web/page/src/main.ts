/** The page: left the robot, right what its inertia matrix says. */

import "./style.css";
import { Client } from "./api/client";
import type { CheckFinding } from "./api/types";
import { button, h } from "./dom";
import { Explorer } from "./explorer";
import { check } from "./panels/check";
import { listenForDrops } from "./panels/drop";
import { edits } from "./panels/edits";
import { figures } from "./panels/figures";
import { heading } from "./panels/heading";
import { joints } from "./panels/joints";
import { line } from "./panels/line";
import { map } from "./panels/map";
import { matrix } from "./panels/matrix";
import { metric } from "./panels/metric";
import { models } from "./panels/models";
import { modes } from "./panels/modes";
import { overlays } from "./panels/overlays";
import { posture } from "./panels/posture";
import { problem } from "./panels/problem";
import { readings } from "./panels/readings";
import { source } from "./panels/source";
import { spectrum } from "./panels/spectrum";
import { tabs } from "./panels/tabs";
import { followAddress, fromLink } from "./state/address";
import { calm } from "./theme";
import { Stage } from "./view/stage";

async function main(): Promise<void> {
  const token = document.querySelector<HTMLMetaElement>('meta[name="eigenbody-token"]')?.content ?? "";
  const client = new Client(token);
  const state = await fromLink(location.hash);
  // Motion begins by the reader's own hand.
  const explorer = new Explorer(client, await client.start(), calm() ? { ...state, swinging: false } : state);
  build(explorer);
  followAddress(explorer);
  listenForDrops(explorer);
  if (!(await explorer.restore()) && explorer.state.source !== null) {
    // A link to a robot that cannot be had: the message stays, the first robot stands in.
    const { failure } = explorer;
    await explorer.open(null, explorer.start.options);
    if (failure) {
      explorer.failure = failure;
      explorer.emit("problem");
    }
  }
  explorer.emit("tab");
}

function build(explorer: Explorer): void {
  const stage = new Stage(explorer);
  const caption = h("p", { class: "caption", hidden: true });
  explorer.on("hover", () => {
    const joint = explorer.hovered === null ? undefined : explorer.model?.joints[explorer.hovered];
    caption.hidden = joint === undefined;
    caption.textContent = joint ? `${joint.name}, ${joint.kind}` : "";
  });
  stage.element.append(caption, h("div", { class: "corner" }, button("Fit", () => stage.fit(), { "aria-label": "Fit the whole robot" })));
  let checked: CheckFinding[] = [];
  const findings = source(explorer, () => checked);
  const checking = check(explorer, (found) => {
    checked = found;
    findings.update();
  });
  const left = h("section", { class: "left", "aria-label": "Robot" },
    ...(stage.notice ? [h("p", { class: "notice" }, stage.notice)] : []), stage.element, overlays(explorer, stage), posture(explorer), joints(explorer));
  const numbers = readings(explorer);
  const right = h("section", { class: "right", tabindex: -1, "aria-label": "Conditioning" }, tabs(explorer, {
    analysis: [modes(explorer), metric(explorer), spectrum(explorer), matrix(explorer)],
    line: [line(explorer), map(explorer)],
    model: [models(explorer)],
    file: [findings.element, checking, edits(explorer)],
    figures: [figures(explorer)],
  }));
  // The numbers stay in sight: above everything where there is room for one column only.
  const narrow = matchMedia("(max-width: 59.99rem)");
  const both = h("main", {}, left, right);
  const settle = () => (narrow.matches ? both : right).prepend(numbers);
  narrow.addEventListener("change", settle);
  settle();
  // A link's hash is the state: this one only takes the focus along.
  const skip = button("To the numbers", () => right.focus(), { class: "skip" });
  document.body.append(skip, heading(explorer), problem(explorer), both);
}

main().catch((error: unknown) => {
  const message = error instanceof Error ? error.message : String(error);
  document.body.append(h("p", { class: "problem", role: "alert" }, `The explorer does not start: ${message}`));
});
