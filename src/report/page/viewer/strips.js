// Numbered marks where test strips belong, in the view and in their table.

class Strips {
    constructor(root, scene, stage, say) {
        this.stage = stage;
        this.say = say;
        this.marks = scene.places.map((place, index) => this.mark(root, place, index + 1));
        for (const button of document.querySelectorAll("[data-strip]")) {
            const number = Number(button.dataset.strip);
            button.hidden = false;
            button.addEventListener("click", () => {
                this.pick(number);
                stage.canvas.scrollIntoView({ block: "center" });
                stage.canvas.focus({ preventScroll: true });
            });
        }
        stage.afterDrawing.push(() => this.follow());
    }

    mark(root, place, number) {
        const button = document.createElement("button");
        button.type = "button";
        button.className = "strip-mark";
        button.textContent = number;
        button.title = place.text;
        button.setAttribute("aria-label", `Test strip ${number}: ${place.text}`);
        button.addEventListener("click", () => this.pick(number));
        root.append(button);
        return { button, place, point: vector(place.point) };
    }

    /** Marks stay where they belong while the view moves. */
    follow() {
        for (const { button, point } of this.marks) {
            const [x, y] = this.stage.onCanvas(point);
            button.style.transform = `translate(${x.toFixed(1)}px, ${y.toFixed(1)}px)`;
        }
    }

    show(isShown) {
        for (const { button } of this.marks) {
            button.hidden = !isShown;
        }
    }

    pick(number) {
        const { place } = this.marks[number - 1];
        for (const [index, { button }] of this.marks.entries()) {
            button.classList.toggle("picked", index + 1 === number);
        }
        for (const row of document.querySelectorAll("tr[data-strip-row]")) {
            row.classList.toggle("picked", Number(row.dataset.stripRow) === number);
        }
        this.say(`Test strip ${number} on ${place.surface}: ${place.text}`);
    }
}
