// Pointers and keys of a viewer.

/// Drags, wheels, pinches, and the position of the pointer.
function listenToFrame(frame) {
    const { node, set, divider } = frame;
    const pointers = new Map();
    const at = event => {
        const box = node.getBoundingClientRect();
        return { x: event.clientX - box.left - node.clientLeft, y: event.clientY - box.top - node.clientTop };
    };
    const move = (dx, dy) => {
        const { width, height } = frame.size();
        set.set({ center: { x: set.center.x - dx / (width * set.zoom), y: set.center.y - dy / (height * set.zoom) } });
    };

    node.addEventListener("pointerdown", event => {
        if (event.target === divider || event.button !== 0) return;
        pointers.set(event.pointerId, at(event));
        node.setPointerCapture(event.pointerId);
        point(event);
    });
    node.addEventListener("pointermove", event => {
        const before = pointers.get(event.pointerId);
        const now = at(event);
        if (before && pointers.size === 1) move(now.x - before.x, now.y - before.y);
        if (before && pointers.size === 2) pinch(event.pointerId, before, now);
        if (before) pointers.set(event.pointerId, now);
        if (event.target !== divider) point(event);
    });
    for (const type of ["pointerup", "pointercancel"])
        node.addEventListener(type, event => pointers.delete(event.pointerId));
    node.addEventListener("pointerleave", event => {
        if (event.pointerType === "mouse" && !pointers.size) set.set({ pointer: null });
    });

    function point(event) {
        const { x, y } = at(event);
        const place = frame.placeAt(x, y);
        const isInside = Math.min(place.x, place.y) >= 0 && Math.max(place.x, place.y) < 1;
        set.set({ pointer: isInside ? place : null });
    }

    /// The ratio of the distances of two fingers is the zoom; the place under the other finger stays there.
    function pinch(id, before, now) {
        const other = [...pointers].find(([key]) => key !== id)[1];
        const distance = p => Math.max(1, Math.hypot(p.x - other.x, p.y - other.y));
        set.zoomBy(distance(now) / distance(before), frame.placeAt(other.x, other.y));
    }

    node.addEventListener("wheel", event => {
        // Without a click or a key before, the wheel moves the page.
        if (!event.ctrlKey && !event.metaKey && document.activeElement !== node) return;
        event.preventDefault();
        const { x, y } = at(event);
        set.zoomBy(2 ** (-clamp(event.deltaY, -200, 200) / 200), frame.placeAt(x, y));
    }, { passive: false });

    divider.addEventListener("pointerdown", event => divider.setPointerCapture(event.pointerId));
    divider.addEventListener("pointermove", event => {
        if (divider.hasPointerCapture(event.pointerId)) set.set({ wipe: at(event).x / frame.size().width });
    });
    divider.addEventListener("keydown", event => {
        const step = { ArrowLeft: -0.02, ArrowRight: 0.02, Home: -1, End: 1 }[event.key];
        if (!step || event.shiftKey) return;
        set.set({ wipe: set.wipe + step });
        event.preventDefault();
        event.stopPropagation();
    });
}

function onViewerKey(viewer, event) {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const isControl = event.target.closest("input, select, button, summary") !== null;
    const { set } = viewer;
    const key = event.key.length === 1 ? event.key.toLowerCase() : event.key;
    const arrow = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] }[key];
    const actions = {
        f: () => viewer.flip(),
        w: () => set.set({ mode: "wipe" }),
        s: () => set.set({ mode: "pair" }),
        a: () => set.set({ mode: "all" }),
        e: () => set.set({ showsErrors: !set.showsErrors }),
        "[": () => set.set({ exposure: set.exposure - 0.5 }),
        "]": () => set.set({ exposure: set.exposure + 0.5 }),
        "+": () => set.zoomBy(2),
        "=": () => set.zoomBy(2),
        "-": () => set.zoomBy(0.5),
        0: () => set.set({ zoom: 1 }),
        1: () => set.zoomBy(1 / viewer.magnification()),
    };
    // Space, arrows and letters mean something else to buttons, sliders and lists.
    if (isControl) {
        if (event.target.closest("select") || !actions[key]) return;
        actions[key]();
    } else if (arrow && event.shiftKey) moveCross(set, arrow);
    else if (arrow) set.set({ center: { x: set.center.x + 0.1 * arrow[0] / set.zoom,
                                        y: set.center.y + 0.1 * arrow[1] / set.zoom } });
    else if (key === " ") viewer.flip();
    else if (actions[key]) actions[key]();
    else return;
    event.preventDefault();
}

/// Moves the cross by a pixel of the left image, from the middle of the frame at first.
function moveCross(set, [dx, dy]) {
    const image = set.images[set.left];
    const { x, y } = image.pixelAt(set.pointer ?? set.center);
    const step = set.pointer ? 1 : 0;
    set.set({ pointer: { x: (clamp(x + step * dx, 0, image.width - 1) + 0.5) / image.width,
                         y: (clamp(y + step * dy, 0, image.height - 1) + 0.5) / image.height } });
}
