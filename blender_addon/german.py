"""The add-on's texts in German."""

GERMAN = {
    # Names
    "Active Vertex": "Aktiver Eckpunkt",
    "Add or Remove Preset": "Voreinstellung hinzufügen oder entfernen",
    "All Visible": "Alle sichtbaren",
    "Angle Error": "Winkelfehler",
    "Angle error, largest": "Winkelfehler, größter",
    "Angle error, mean": "Winkelfehler, Mittel",
    "Angle error, rms": "Winkelfehler, quadr. Mittel",
    "Area Balance": "Flächenausgleich",
    "Area ratio": "Flächenverhältnis",
    "Augmented Lagrangian": "Erweiterter Lagrange",
    "Automatic": "Automatisch",
    "By": "Nach",
    "Center": "Mitte",
    "Closed Surfaces": "Geschlossene Flächen",
    "Conformal Disk Unwrap": "Konform auf Scheiben abwickeln",
    "Conformal Rectangle Unwrap": "Konform auf Rechtecke abwickeln",
    "Conformal Sphere Map": "Konforme Kugelabbildung",
    "Conformal UV": "Konforme UV",
    "Conformal Unwrap": "Konformes Abwickeln",
    "Conformal Unwrap with Options": "Konformes Abwickeln mit Optionen",
    "Conformal Unwrap with Options...": "Konformes Abwickeln mit Optionen ...",
    "Corners": "Ecken",
    "Correct Aspect": "Seitenverhältnis ausgleichen",
    "Cut": "Aufschneiden",
    "Disk": "Scheibe",
    "Equirectangular": "Längen und Breiten",
    "Esc: Cancel": "Esc: Abbrechen",
    "Faces": "Flächen",
    "Fill Holes": "Löcher füllen",
    "Fit the Square": "Quadrat füllen",
    "Flipped faces": "Umgeklappte Flächen",
    "Free": "Frei",
    "Islands": "Inseln",
    "Keep Size and Pack": "Größe behalten und packen",
    "Last Result": "Letztes Ergebnis",
    "Least Stretch": "Geringste Dehnung",
    "Linear": "Linear",
    "Margin": "Abstand",
    "Measuring ...": "Wird gemessen ...",
    "Method": "Verfahren",
    "Name": "Name",
    "Newton": "Newton",
    "None": "Keine",
    "Nothing unwrapped yet": "Noch nichts abgewickelt",
    "Octahedral": "Oktaeder",
    "Off": "Aus",
    "Options": "Optionen",
    "Place": "Anordnen",
    "Presets": "Voreinstellungen",
    "Rectangle": "Rechteck",
    "Refine": "Verfeinern",
    "Refuse": "Ablehnen",
    "Repair Folds": "Falten glätten",
    "Rotation": "Drehung",
    "Schwarz": "Schwarz",
    "Select Flipped or Collapsed": "Umgeklappte oder leere auswählen",
    "Select Most Distorted": "Am stärksten verzerrte auswählen",
    "Select the Worst Faces": "Die schlechtesten Flächen auswählen",
    "Selected": "Ausgewählte",
    "Shape": "Form",
    "Share": "Anteil",
    "Sharpest Turns": "Schärfste Biegungen",
    "Shortcuts": "Tastenkürzel",
    "Texture covered": "Textur bedeckt",
    "The first unwrap from the window starts with": "Das erste Abwickeln aus dem Fenster beginnt mit",
    "Too small to store": "Zu klein zum Speichern",
    "UV Map": "UV-Karte",
    "UVs": "UVs",
    "Unwrap": "Abwickeln",
    "Upright": "Aufrecht",
    "Use Free": "Frei abwickeln",
    "Use Pins": "Angeheftete nutzen",
    "Use Subdivision Surface": "Unterteilte Fläche nutzen",
    "Y Up": "Y nach oben",
    "Z Up": "Z nach oben",
    # Descriptions of operators
    "Add a shape key that turns each selected closed mesh into a sphere, keeping angles.\n"
    "For closed meshes without handles; UVs are written on request": (
        "Fügt einen Formschlüssel hinzu, der jedes ausgewählte geschlossene Netz winkeltreu zur Kugel macht.\n"
        "Für geschlossene Netze ohne Henkel; UVs werden auf Wunsch geschrieben"
    ),
    "Choose shape, presets and all other options, then unwrap.\n"
    "The options are those of the sidebar, and stay for the next time": (
        "Form, Voreinstellungen und alle anderen Optionen wählen, dann abwickeln.\n"
        "Es sind die Optionen der Seitenleiste, und sie bleiben für das nächste Mal"
    ),
    "Keep the options under a name, or remove the preset.\nThe panel after an unwrap has the same presets": (
        "Die Optionen unter einem Namen behalten, oder die Voreinstellung entfernen.\n"
        "Das Feld nach dem Abwickeln hat dieselben Voreinstellungen"
    ),
    "Select visible faces whose UVs are inverted or have no area, in the active UV map.\n"
    "Textures show mirrored or smeared there": (
        "Sichtbare Flächen auswählen, deren UVs in der aktiven UV-Karte umgeklappt sind oder keinen Inhalt haben.\n"
        "Texturen erscheinen dort gespiegelt oder verschmiert"
    ),
    "Select visible faces whose angles differ most from those in the active UV map.\n"
    "Seams across them, or another shape, help most": (
        "Sichtbare Flächen auswählen, deren Winkel am stärksten von denen in der aktiven UV-Karte abweichen.\n"
        "Nähte durch sie, oder eine andere Form, helfen am meisten"
    ),
    "Unwrap each island of the selected faces, keeping angles.": (
        "Jede Insel der ausgewählten Flächen winkeltreu abwickeln."
    ),
    "Unwrap each island of the selected faces, keeping angles.\n"
    "Mark seams first; in Object Mode a mesh without selected faces is unwrapped as a whole": (
        "Jede Insel der ausgewählten Flächen winkeltreu abwickeln.\n"
        "Zuerst Nähte markieren; im Objektmodus wird ein Netz ohne ausgewählte Flächen als Ganzes abgewickelt"
    ),
    # Descriptions of options
    "All faces of which a corner is off by more than the angle": (
        "Alle Flächen, bei denen eine Ecke um mehr als den Winkel abweicht"
    ),
    "All visible faces": "Alle sichtbaren Flächen",
    "As many faces of each mesh as the share says, the worst ones": (
        "So viele Flächen jedes Netzes, wie der Anteil sagt, und zwar die schlechtesten"
    ),
    "Close all boundaries of an island but its longest for the solution.\nOff: islands with holes are refused": (
        "Für die Lösung alle Ränder einer Insel außer ihrem längsten schließen.\n"
        "Aus: Inseln mit Löchern werden abgelehnt"
    ),
    "Cut them open along edges": "Entlang von Kanten aufschneiden",
    "Disks: three pinned UVs on an island's boundary go to three equally spaced points of the circle.\n"
    "Rectangles: four pinned UVs on the boundary are the corners; of a mesh without pins four selected vertices, "
    "while no face is selected": (
        "Scheiben: drei angeheftete UVs auf dem Rand einer Insel kommen auf drei gleich weit entfernte Kreispunkte.\n"
        "Rechtecke: vier angeheftete UVs auf dem Rand sind die Ecken; ohne angeheftete vier ausgewählte Eckpunkte, "
        "solange keine Fläche ausgewählt ist"
    ),
    "How the map is computed.\nAutomatic unless time or a comparison matters": (
        "Wie die Abbildung berechnet wird.\nAutomatisch, wenn es nicht auf Zeit oder einen Vergleich ankommt"
    ),
    "Islands are not turned": "Inseln werden nicht gedreht",
    "Islands become rectangles of the proportions that keep angles: for strips, panels and tiles": (
        "Inseln werden Rechtecke in den Maßen, die Winkel erhalten: für Streifen, Tafeln und Kacheln"
    ),
    "Islands become round: for maps that are compared or composed with others on the disk": (
        "Inseln werden rund: für Abbildungen, die auf der Scheibe mit anderen verglichen oder verkettet werden"
    ),
    "Islands keep their own outline, as long as on the surface: for most meshes; what can be unrolled keeps its "
    "lengths too": (
        "Inseln behalten ihren eigenen Umriss, so lang wie auf der Oberfläche: für die meisten Netze; was sich "
        "abrollen lässt, behält auch seine Längen"
    ),
    "Islands keep their relative size; Blender packs those of all objects together": (
        "Inseln behalten ihr Größenverhältnis; Blender packt die aller Objekte gemeinsam"
    ),
    "Keep angles on the image of the active face's material.\nFor textures that are not square": (
        "Winkel auf dem Bild im Material der aktiven Fläche erhalten.\nFür Texturen, die nicht quadratisch sind"
    ),
    "Layout that is written into the active UV map.\nNone leaves the UVs as they are": (
        "Anordnung, die in die aktive UV-Karte geschrieben wird.\nKeine lässt die UVs, wie sie sind"
    ),
    "Leave islands without a boundary, or with handles, as they are and say so": (
        "Inseln ohne Rand oder mit Henkeln lassen, wie sie sind, und es sagen"
    ),
    "Leave the UVs as they are": "Die UVs lassen, wie sie sind",
    "Linear or Newton, whichever keeps the angles of an island better": (
        "Linear oder Newton, je nachdem, was die Winkel einer Insel besser erhält"
    ),
    "Longitude and latitude; faces across the seam go on beyond 1": (
        "Länge und Breite; Flächen über der Naht gehen über 1 hinaus"
    ),
    "Map the surface as the Subdivision Surface modifier makes it.\n"
    "When the subdivided object is what gets the texture": (
        "Die Oberfläche abbilden, wie der Modifikator Subdivision Surface sie macht.\n"
        "Wenn das unterteilte Objekt die Textur bekommt"
    ),
    "Move all vertices for the last percents of angle error, never to the worse.\n"
    "For final maps: takes about four times as long": (
        "Alle Eckpunkte für die letzten Prozente Winkelfehler verschieben, nie zum Schlechteren.\n"
        "Für endgültige Karten: dauert etwa viermal so lang"
    ),
    "Of several choices the one whose map changes areas least; slower": (
        "Von mehreren die Wahl, deren Abbildung Flächeninhalte am wenigsten ändert; langsamer"
    ),
    "Of the preset": "Der Voreinstellung",
    "Of the visible faces of each mesh": "Der sichtbaren Flächen jedes Netzes",
    "One factorization: the Riemann map read off a Green's function; the fastest": (
        "Eine Faktorisierung: die Riemannsche Abbildung aus einer Greenschen Funktion; am schnellsten"
    ),
    "One factorization; the fastest": "Eine Faktorisierung; am schnellsten",
    "One island fills the unit square; several are packed by conformal_uv: of all objects in Edit Mode together, of "
    "selected objects in Object Mode each by itself": (
        "Eine Insel füllt das Einheitsquadrat; mehrere packt conformal_uv: im Bearbeitungsmodus die aller Objekte "
        "gemeinsam, im Objektmodus die jedes ausgewählten Objekts für sich"
    ),
    "Selected, visible faces; in Object Mode all visible faces of a mesh with no face selected": (
        "Ausgewählte, sichtbare Flächen; im Objektmodus alle sichtbaren eines Netzes, in dem keine ausgewählt ist"
    ),
    "Space between islands, as a part of the square's side.\nOne island alone fills the square": (
        "Raum zwischen Inseln, als Teil der Seite des Quadrats.\nEine Insel allein füllt das Quadrat"
    ),
    "The active vertex of each object, in the island in whose interior it lies": (
        "Der aktive Eckpunkt jedes Objekts, in der Insel, in deren Innerem er liegt"
    ),
    "The algorithm of Choi's report with three pins; slow, for comparison": (
        "Der Algorithmus aus Chois Bericht mit drei festen Punkten; langsam, zum Vergleich"
    ),
    "The least angle by which a corner of a selected face is off": (
        "Der kleinste Winkel, um den eine Ecke einer ausgewählten Fläche abweicht"
    ),
    "The least conformal energy, by Newton's method on the boundary angles; where an island is crowded, Linear may "
    "keep angles better": (
        "Die geringste konforme Energie, nach Newton in den Randwinkeln; wo eine Insel gedrängt ist, kann Linear "
        "Winkel besser erhalten"
    ),
    "The least conformal energy; for coarse meshes": "Die geringste konforme Energie; für grobe Netze",
    "The method that keeps the angles best": "Das Verfahren, das Winkel am besten erhält",
    "The octahedron unfolded to a square": "Das Oktaeder, zum Quadrat entfaltet",
    "The place deepest inside each island": "Die Stelle am tiefsten in jeder Insel",
    "Turn every island about its center.\nAfter all else, Upright too": (
        "Jede Insel um ihre Mitte drehen.\nNach allem anderen, auch nach Aufrecht"
    ),
    "Turn every island so that up on the surface is up in the texture.\nDisks with pins are not turned": (
        "Jede Insel so drehen, dass oben auf der Oberfläche oben in der Textur ist.\n"
        "Scheiben mit angehefteten UVs werden nicht gedreht"
    ),
    "Two overlapping parts in turn; for large scans and long limbs": (
        "Zwei überlappende Teile abwechselnd; für große Scans und lange Glieder"
    ),
    "UV map to write, made when missing.\nEmpty: the active one": (
        "UV-Karte, die geschrieben wird, angelegt, wenn sie fehlt.\nLeer: die aktive"
    ),
    "Unfold faces that came out inverted.\nOff: they stay, and are counted": (
        "Flächen auffalten, die umgeklappt herauskamen.\nAus: sie bleiben, und werden gezählt"
    ),
    "What comes to the middle of the disk.\nArea Balance where parts come out too small": (
        "Was in die Mitte der Scheibe kommt.\nFlächenausgleich, wo Teile zu klein herauskommen"
    ),
    "What gives all parts of an island the most even share of the disk's area": (
        "Was allen Teilen einer Insel den gleichmäßigsten Anteil an der Scheibe gibt"
    ),
    "What is up along Y points up in the texture; of what lies flat, what is up along -Z": (
        "Was entlang Y oben ist, zeigt in der Textur nach oben; bei dem, was flach liegt, was entlang -Z oben ist"
    ),
    "What is up along Z points up in the texture; of what lies flat, what is up along Y": (
        "Was entlang Z oben ist, zeigt in der Textur nach oben; bei dem, was flach liegt, was entlang Y oben ist"
    ),
    "What islands become.\nFree for most meshes, Disk for round islands, Rectangle for strips": (
        "Was aus Inseln wird.\nFrei für die meisten Netze, Scheibe für runde Inseln, Rechteck für Streifen"
    ),
    "What the corners of a rectangle are.\nWhere no pins give them": (
        "Was die Ecken eines Rechtecks sind.\nWo keine angehefteten UVs sie angeben"
    ),
    "What to do with islands that have no boundary, or handles.\nCut where seams are too much work": (
        "Was mit Inseln geschieht, die keinen Rand oder Henkel haben.\nAufschneiden, wo Nähte zu viel Arbeit sind"
    ),
    "Where islands go in the texture.\nKeep Size and Pack where they share a density": (
        "Wohin Inseln in der Textur kommen.\nGröße behalten und packen, wo sie eine Dichte teilen"
    ),
    "Where the boundary turns most": "Wo der Rand sich am stärksten biegt",
    "Which faces are selected": "Welche Flächen ausgewählt werden",
    "Which faces are unwrapped.\nAll Visible spares selecting them": (
        "Welche Flächen abgewickelt werden.\nAlle sichtbaren erspart das Auswählen"
    ),
    # Reports
    "Areas change up to {ratio:.3g} times: cut long limbs off by seams": (
        "Flächeninhalte ändern sich bis zu {ratio:.3g}-fach: lange Glieder durch Nähte abtrennen"
    ),
    "Areas change up to {ratio:.3g} times: let islands keep their own outline, or cut them": (
        "Flächeninhalte ändern sich bis zu {ratio:.3g}-fach: Inseln ihren eigenen Umriss lassen oder sie aufschneiden"
    ),
    "Blender's Python {version} has no {name}: install the extension's zip for this platform, or your distribution's "
    "package of {name}": (
        "Blenders Python {version} hat kein {name}: die Zip-Datei der Erweiterung für diese Plattform installieren, "
        "oder das Paket {name} der Distribution"
    ),
    "Blender's packer left the islands as they were; conformal_uv packed them": (
        "Blenders Packer ließ die Inseln, wie sie waren; conformal_uv hat sie gepackt"
    ),
    "Cancelled; nothing was changed": "Abgebrochen; nichts wurde geändert",
    "Changed since then: these numbers are of the map as it was": (
        "Seither geändert: diese Zahlen gelten der Karte, wie sie war"
    ),
    "Face {face}: {why}": "Fläche {face}: {why}",
    "Go to Edit Mode": "In den Bearbeitungsmodus wechseln",
    "Go to Object Mode": "In den Objektmodus wechseln",
    "Go to Object Mode or to Edit Mode of a mesh": (
        "In den Objektmodus oder in den Bearbeitungsmodus eines Netzes wechseln"
    ),
    "Islands that failed can be unwrapped with another option": (
        "Misslungene Inseln können mit einer anderen Option abgewickelt werden"
    ),
    "Mapped {done} of {count} mesh to a sphere": "{done} von {count} Netz auf eine Kugel abgebildet",
    "Mapped {done} of {count} meshes to spheres": "{done} von {count} Netzen auf Kugeln abgebildet",
    "Mean angle error {angle:.0f}°: let islands keep their own outline, or cut them": (
        "Mittlerer Winkelfehler {angle:.0f}°: Inseln ihren eigenen Umriss lassen oder sie aufschneiden"
    ),
    "Mean angle error {angle:.0f}°: mark seams across the worst faces, then unwrap again": (
        "Mittlerer Winkelfehler {angle:.0f}°: Nähte durch die schlechtesten Flächen markieren, dann neu abwickeln"
    ),
    "Select a mesh object": "Ein Netzobjekt auswählen",
    "The mesh or its selection was changed meanwhile; nothing was written": (
        "Das Netz oder seine Auswahl wurde inzwischen geändert; nichts wurde geschrieben"
    ),
    "Unwrapped {done} of {count} island": "{done} von {count} Insel abgewickelt",
    "Unwrapped {done} of {count} island of {objects} objects": (
        "{done} von {count} Insel von {objects} Objekten abgewickelt"
    ),
    "Unwrapped {done} of {count} islands": "{done} von {count} Inseln abgewickelt",
    "Unwrapped {done} of {count} islands of {objects} objects": (
        "{done} von {count} Inseln von {objects} Objekten abgewickelt"
    ),
    "Wait for the work that is under way, or press Esc": "Die laufende Arbeit abwarten, oder Esc drücken",
    "active vertex {vertex} belongs to no selected face": (
        "der aktive Eckpunkt {vertex} gehört zu keiner ausgewählten Fläche"
    ),
    "and {count} more": "und {count} weitere",
    "it has eight UV maps already; remove one": "es hat schon acht UV-Karten; eine entfernen",
    "no UV is selected": "keine UV ist ausgewählt",
    "no face is visible": "keine Fläche ist sichtbar",
    "no pin and no selected vertex gives corners, they are automatic; pin four UVs on the boundary, or select four "
    "vertices there and no face": (
        "keine angeheftete UV und kein ausgewählter Eckpunkt gibt Ecken an, sie sind automatisch; vier UVs auf dem "
        "Rand anheften, oder dort vier Eckpunkte und keine Fläche auswählen"
    ),
    "no vertex is active, the center is automatic; in Edit Mode, click a vertex first": (
        "kein Eckpunkt ist aktiv, die Mitte ist automatisch; im Bearbeitungsmodus zuerst einen Eckpunkt anklicken"
    ),
    "no visible face is selected": "keine sichtbare Fläche ist ausgewählt",
    "no visible face is selected; turn on Use Pins where selected vertices are to be corners of all visible faces' "
    "islands": (
        "keine sichtbare Fläche ist ausgewählt; Angeheftete nutzen einschalten, wo ausgewählte Eckpunkte die Ecken "
        "der Inseln aller sichtbaren Flächen sein sollen"
    ),
    "pinned UVs stay where they are; unpin them": "angeheftete UVs bleiben, wo sie sind; sie lösen",
    "pinned UVs stay where they are; unpin them, or pin four on the boundary and turn on Use Pins": (
        "angeheftete UVs bleiben, wo sie sind; sie lösen, oder vier auf dem Rand anheften und Angeheftete nutzen "
        "einschalten"
    ),
    "pinned UVs stay where they are; unpin them, or pin three on the boundary and turn on Use Pins": (
        "angeheftete UVs bleiben, wo sie sind; sie lösen, oder drei auf dem Rand anheften und Angeheftete nutzen "
        "einschalten"
    ),
    "rectangle-packer is not installed; Blender packed the islands": (
        "rectangle-packer ist nicht installiert; Blender hat die Inseln gepackt"
    ),
    "rectangle-packer is not installed; the islands lie in a grid": (
        "rectangle-packer ist nicht installiert; die Inseln liegen in einem Raster"
    ),
    "set {option} to {value}": "{option} auf {value} stellen",
    "some of its UVs are not selected; select whole islands": (
        "einige ihrer UVs sind nicht ausgewählt; ganze Inseln auswählen"
    ),
    "the mesh has no faces": "das Netz hat keine Flächen",
    "the mesh is in Edit Mode through another object; leave Edit Mode there": (
        "das Netz ist durch ein anderes Objekt im Bearbeitungsmodus; ihn dort verlassen"
    ),
    "the mesh is linked from another file; make it local first": (
        "das Netz ist aus einer anderen Datei verknüpft; es zuerst lokal machen"
    ),
    "the scale is not uniform, and the mesh is mapped without it; apply it first (Ctrl A)": (
        "die Skalierung ist nicht gleichmäßig, und das Netz wird ohne sie abgebildet; sie zuerst anwenden (Strg A)"
    ),
    "there is no UV map {name!r} and no room for it: Blender keeps eight UV maps in a mesh; remove one or name one "
    "of them": (
        "es gibt keine UV-Karte {name!r} und keinen Platz für sie: Blender hält acht UV-Karten in einem Netz; eine "
        "entfernen oder eine von ihnen nennen"
    ),
    "turn on Fill Holes": "Löcher füllen einschalten",
    "use Object > Conformal Sphere Map": "Objekt > Konforme Kugelabbildung nutzen",
    "{count} face is flipped or collapsed": "{count} Fläche ist umgeklappt oder verschwunden",
    "{count} face is inverted": "{count} Fläche ist umgeklappt",
    "{count} face is selected": "{count} Fläche ist ausgewählt",
    "{count} face is too small to be stored; it crowds on the boundary": (
        "{count} Fläche ist zu klein zum Speichern; sie drängt sich am Rand"
    ),
    "{count} faces are flipped or collapsed": "{count} Flächen sind umgeklappt oder verschwunden",
    "{count} faces are inverted": "{count} Flächen sind umgeklappt",
    "{count} faces are selected": "{count} Flächen sind ausgewählt",
    "{count} faces are too small to be stored; they crowd on the boundary": (
        "{count} Flächen sind zu klein zum Speichern; sie drängen sich am Rand"
    ),
    "{count} island stopped before the method's tolerance": (
        "{count} Insel blieb vor der Genauigkeit des Verfahrens stehen"
    ),
    "{count} islands stopped before the method's tolerance": (
        "{count} Inseln blieben vor der Genauigkeit des Verfahrens stehen"
    ),
    "{count} triangle is too small for the single precision of UVs; cut the island with seams": (
        "{count} Dreieck ist zu klein für die einfache Genauigkeit der UVs; die Insel durch Nähte teilen"
    ),
    "{count} triangles are too small for the single precision of UVs; cut the island with seams": (
        "{count} Dreiecke sind zu klein für die einfache Genauigkeit der UVs; die Insel durch Nähte teilen"
    ),
    "{done} of {count}": "{done} von {count}",
    "{done} of {count} island, {seconds:.2f} s": "{done} von {count} Insel, {seconds:.2f} s",
    "{done} of {count} islands, {seconds:.2f} s": "{done} von {count} Inseln, {seconds:.2f} s",
    "{name!r} is an attribute that is no UV map; choose another name": (
        "{name!r} ist ein Attribut, das keine UV-Karte ist; einen anderen Namen wählen"
    ),
    "{object}, face {faces}: {why}": "{object}, Fläche {faces}: {why}",
    "{object}, faces {faces}: {why}": "{object}, Flächen {faces}: {why}",
}
