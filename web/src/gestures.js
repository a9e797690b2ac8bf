// Mouse, fingers, wheel and keys on a canvas, told as what they mean.

const STEP = 0.05; // of an arrow key, in the picture's half heights

/**
 * `to` has: hover(point or null), begin(point, turning), drag(point, [dx, dy] in heights, turning), end(), zoom(factor),
 * arrow([x, y], turning), reset(), middle(). Points are pixels from the canvas's upper left; `turning` says that Shift
 * or the right button is held, or that two fingers are there.
 */
export function listen(canvas, to) {
  const fingers = new Map();
  let spread = 0;
  const at = (event) => {
    const box = canvas.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  };
  const apart = () => {
    const [a, b] = [...fingers.values()];
    return Math.hypot(a[0] - b[0], a[1] - b[1]);
  };
  const middle = () => {
    const all = [...fingers.values()];
    return [0, 1].map((k) => all.reduce((sum, p) => sum + p[k], 0) / all.length);
  };
  let turning = false;
  let last = null;

  canvas.addEventListener("pointerdown", (event) => {
    canvas.setPointerCapture(event.pointerId);
    fingers.set(event.pointerId, at(event));
    turning = event.shiftKey || event.button === 2 || fingers.size > 1;
    spread = fingers.size === 2 ? apart() : 0;
    last = middle();
    to.begin(last, turning);
  });
  canvas.addEventListener("pointermove", (event) => {
    if (!fingers.has(event.pointerId)) {
      to.hover(at(event));
      return;
    }
    fingers.set(event.pointerId, at(event));
    const now = middle();
    const height = canvas.clientHeight || 1;
    to.drag(now, [(now[0] - last[0]) / height, (last[1] - now[1]) / height], turning);
    last = now;
    if (fingers.size === 2) {
      const wide = apart();
      if (spread > 0) to.zoom(wide / spread);
      spread = wide;
    }
  });
  const up = (event) => {
    if (!fingers.delete(event.pointerId)) return;
    if (fingers.size) {
      last = middle();
      to.begin(last, turning);
    } else {
      to.end();
      to.hover(at(event));
    }
  };
  canvas.addEventListener("pointerup", up);
  canvas.addEventListener("pointercancel", up);
  canvas.addEventListener("pointerleave", (event) => event.pointerType === "mouse" && to.hover(null));
  canvas.addEventListener("contextmenu", (event) => event.preventDefault());
  canvas.addEventListener(
    "wheel",
    (event) => {
      if (document.activeElement !== canvas && !event.ctrlKey) return; // the page scrolls on
      event.preventDefault();
      to.zoom(Math.exp(-event.deltaY * (event.deltaMode ? 0.05 : 0.0015)));
    },
    { passive: false },
  );
  canvas.addEventListener("keydown", (event) => {
    if (event.altKey || event.metaKey || event.ctrlKey) return;
    const arrows = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
    if (event.key in arrows) to.arrow(arrows[event.key].map((x) => x * STEP), event.shiftKey);
    else if (event.key === "+" || event.key === "=") to.zoom(1.2);
    else if (event.key === "-") to.zoom(1 / 1.2);
    else if (event.key === "0" || event.key === "Home") to.reset();
    else if (event.key === "Enter" || event.key === " ") to.middle();
    else return;
    event.preventDefault();
  });
}
