/** Styles of the widget; notebooks have no style sheet of ours. */
export const STYLE = `
.seafoam-widget { display: grid; grid-template-columns: minmax(0, 1fr) auto; gap: 8px; }
.seafoam-main { position: relative; aspect-ratio: 16 / 9; overflow: hidden; }
.seafoam-picture, .seafoam-picture canvas { position: absolute; inset: 0; width: 100%; height: 100%; }
.seafoam-picture canvas { touch-action: pan-y; }
.seafoam-bar { position: absolute; left: 8px; bottom: 8px; display: flex; gap: 4px; }
.seafoam-bar button { font: 13px system-ui, sans-serif; padding: 4px 10px; border: 0; border-radius: 4px; color: #fff; background: rgb(0 0 0 / 0.55); cursor: pointer; }
.seafoam-bar button:focus-visible { outline: 2px solid #fff; }
.seafoam-message { position: absolute; inset: 8px 8px auto; margin: 0; padding: 6px 10px; font: 13px system-ui, sans-serif; color: #fff; background: #8b1a1a; border-radius: 4px; }
.seafoam-message[hidden], .seafoam-side[hidden] { display: none; }
/* As high as the picture, whatever it holds. */
.seafoam-side { width: 300px; height: 0; min-height: 100%; overflow: auto; }
.seafoam-side .with-log { display: flex; gap: 4px; }
.seafoam-side .with-log .log { flex: 1 1 60%; min-width: 0; }
`;
