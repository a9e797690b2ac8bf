"""The add-on's texts in German."""

GERMAN = {
    # Names
    "Active Vertex": "Aktiver Eckpunkt",
    "Add": "Addieren",
    "Add or Remove Preset": "Voreinstellung hinzufügen oder entfernen",
    "All Visible": "Alle sichtbaren",
    "Angle Error": "Winkelfehler",
    "Angle error, largest": "Winkelfehler, größter",
    "Angle error, mean": "Winkelfehler, Mittel",
    "Angle error, rms": "Winkelfehler, quadr. Mittel",
    "Angles": "Winkel",
    "Any": "Beliebig",
    "Area Balance": "Flächenausgleich",
    "Area ratio": "Flächenverhältnis",
    "Areas": "Flächeninhalte",
    "As the Surface": "Wie die Oberfläche",
    "As the UVs": "Wie die UVs",
    "Augmented Lagrangian": "Erweiterter Lagrange",
    "Automatic": "Automatisch",
    "Average Scale": "Größen angleichen",
    "Axis-aligned": "An den Achsen",
    "Between": "Dazwischen",
    "Boundary Shape (Convex)": "Hülle (konvex)",
    "Bounding Box": "Rahmen",
    "By": "Nach",
    "Cardinal": "Vierteldrehungen",
    "Center": "Mitte",
    "Closed Surfaces": "Geschlossene Flächen",
    "Conformal Angle Distortion": "Konforme Winkelverzerrung",
    "Conformal Area Distortion": "Konforme Flächenverzerrung",
    "Conformal Disk Unwrap": "Konform auf Scheiben abwickeln",
    "Conformal Distortion Off": "Konforme Verzerrung aus",
    "Conformal Distortion Overlay": "Konforme Verzerrung einblenden",
    "Conformal Flatten": "Konform flach legen",
    "Conformal Live Pins": "Konform an Nadeln ziehen",
    "Conformal Pack Islands": "Inseln konform packen",
    "Conformal Rectangle Unwrap": "Konform auf Rechtecke abwickeln",
    "Conformal Slide": "Konform schieben",
    "Conformal Sphere Map": "Konforme Kugelabbildung",
    "Conformal Sphere Slide": "Kugel konform schieben",
    "Conformal UV": "Konforme UV",
    "Conformal Unwrap": "Konformes Abwickeln",
    "Conformal Unwrap with Options": "Konformes Abwickeln mit Optionen",
    "Conformal Unwrap with Options...": "Konformes Abwickeln mit Optionen ...",
    "Corners": "Ecken",
    "Correct Aspect": "Seitenverhältnis ausgleichen",
    "Cut": "Aufschneiden",
    "Disk": "Scheibe",
    "Disk, three pins": "Scheibe, drei angeheftete",
    "Equirectangular": "Längen und Breiten",
    "Esc: Cancel": "Esc: Abbrechen",
    "Exact Shape (Concave)": "Genauer Umriss (konkav)",
    "Faces": "Flächen",
    "Fill Holes": "Löcher füllen",
    "Fit the Square": "Quadrat füllen",
    "Flipped faces": "Umgeklappte Flächen",
    "Fraction": "Anteil",
    "Free": "Frei",
    "Free, {count} pins": "Frei, {count} angeheftete",
    "Gap": "Lücke",
    "Image Size": "Bildgröße",
    "Islands": "Inseln",
    "Keep Scale": "Größe behalten",
    "Last Result": "Letztes Ergebnis",
    "Least Stretch": "Geringste Dehnung",
    "Limit": "Grenze",
    "Linear": "Linear",
    "Margin": "Abstand",
    "Margin Method": "Art des Abstands",
    "Measuring ...": "Wird gemessen ...",
    "Method": "Verfahren",
    "Name": "Name",
    "New Object": "Neues Objekt",
    "Newton": "Newton",
    "None": "Keine",
    "Nothing": "Nichts",
    "Nothing unwrapped yet": "Noch nichts abgewickelt",
    "Octahedral": "Oktaeder",
    "Off": "Aus",
    "Options": "Optionen",
    "Pack Together": "Gemeinsam packen",
    "Pixels": "Pixel",
    "Place": "Anordnen",
    "Presets": "Voreinstellungen",
    "Rectangle": "Rechteck",
    "Refine": "Verfeinern",
    "Refuse": "Ablehnen",
    "Repair Folds": "Falten glätten",
    "Result": "Ergebnis",
    "Rotate": "Drehen",
    "Rotation": "Drehung",
    "Rotation {rotation}°   X {x}   Y {y}": "Drehung {rotation}°   X {x}   Y {y}",
    "Rotation {rotation}°   X {x}   Y {y}   Z {z}": "Drehung {rotation}°   X {x}   Y {y}   Z {z}",
    "Scaled": "Skaliert",
    "Schwarz": "Schwarz",
    "Select Flipped or Collapsed": "Umgeklappte oder leere auswählen",
    "Select Most Distorted": "Am stärksten verzerrte auswählen",
    "Select the Worst Faces": "Die schlechtesten Flächen auswählen",
    "Selected": "Ausgewählte",
    "Shape": "Form",
    "Shape Key": "Formschlüssel",
    "Shape Method": "Art der Form",
    "Share": "Anteil",
    "Sharpest Turns": "Schärfste Biegungen",
    "Shortcuts": "Tastenkürzel",
    "Show": "Zeigen",
    "Size": "Größe",
    "Texture covered": "Textur bedeckt",
    "The first unwrap from the window starts with": "Das erste Abwickeln aus dem Fenster beginnt mit",
    "Too small to store": "Zu klein zum Speichern",
    "Toward": "Hin zu",
    "UDIM Tile": "UDIM-Kachel",
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
    "Drag a pinned UV, or a selected one on the boundary.\nThe island follows, its other pins stay": (
        "Eine angeheftete UV ziehen, oder eine ausgewählte auf dem Rand.\n"
        "Die Insel folgt, ihre anderen angehefteten UVs bleiben"
    ),
    "Drag pinned UVs, and the island follows at once, keeping angles; without a drag, map islands from their pins.\n"
    "Two pins or more stay where they are; three on a disk's boundary turn and slide the disk": (
        "Angeheftete UVs ziehen, und die Insel folgt sofort, winkeltreu; ohne Ziehen Inseln aus ihren angehefteten "
        "UVs abbilden.\n"
        "Zwei oder mehr bleiben, wo sie sind; drei auf dem Rand einer Scheibe drehen und schieben sie"
    ),
    "Drag what should go elsewhere in a disk, the wheel turns it.\nOn a sphere the wheel magnifies what it is over": (
        "Ziehen, was in einer Scheibe woanders hin soll, das Mausrad dreht sie.\n"
        "Auf einer Kugel vergrößert das Mausrad, worüber es steht"
    ),
    "Keep the options under a name, or remove the preset.\nThe panel after an unwrap has the same presets": (
        "Die Optionen unter einem Namen behalten, oder die Voreinstellung entfernen.\n"
        "Das Feld nach dem Abwickeln hat dieselben Voreinstellungen"
    ),
    "Lay each selected mesh flat as its active UV map does.\nFor patterns, cutting, prints and Geometry Nodes": (
        "Jedes ausgewählte Netz flach legen, wie seine aktive UV-Karte es tut.\n"
        "Für Schnittmuster, Zuschnitt, Drucke und Geometrieknoten"
    ),
    "Pack the islands of all edited or selected objects into the square, by their outlines.\n"
    "Whatever unwrapped them; fills more than boxes do": (
        "Die Inseln aller bearbeiteten oder ausgewählten Objekte nach ihren Umrissen ins Quadrat packen.\n"
        "Was immer sie abgewickelt hat; füllt mehr als Rahmen es tun"
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
    "Show how the active UV map changes angles or areas as colours on the surface, or stop showing it.\n"
    "To see where seams are missing; attributes of faces hold the numbers": (
        "Als Farben auf der Oberfläche zeigen, wie die aktive UV-Karte Winkel oder Flächeninhalte ändert, oder nicht "
        "mehr zeigen.\n"
        "Um zu sehen, wo Nähte fehlen; Attribute der Flächen enthalten die Zahlen"
    ),
    "Slide what is in the middle of a disk elsewhere, and turn it, keeping angles.\n"
    "Drag what should go elsewhere; islands whose boundary is a circle can be slid": (
        "Was in der Mitte einer Scheibe ist, winkeltreu woanders hin schieben, und sie drehen.\n"
        "Ziehen, was woanders hin soll; es geht mit Inseln, deren Rand ein Kreis ist"
    ),
    "Turn the sphere that a closed mesh was mapped to, and magnify what lies under the mouse, keeping angles.\n"
    "Moves the shape key of Conformal Sphere Map and the UVs that were written with it": (
        "Die Kugel drehen, auf die ein geschlossenes Netz abgebildet wurde, und winkeltreu vergrößern, was unter der "
        "Maus liegt.\n"
        "Bewegt den Formschlüssel der konformen Kugelabbildung und die UVs, die mit ihm geschrieben wurden"
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
    "A flat mesh beside the object, torn along its seams": (
        "Ein flaches Netz neben dem Objekt, entlang seiner Nähte getrennt"
    ),
    "A part of a tenth of the sum of the islands' sides, scaled as they are": (
        "Ein Teil eines Zehntels der Summe der Seiten der Inseln, skaliert wie sie"
    ),
    "A part of the square's side": "Ein Teil der Seite des Quadrats",
    "A part of the square's side, between islands as to the sides of the square": (
        "Ein Teil der Seite des Quadrats, zwischen Inseln wie zu den Seiten des Quadrats"
    ),
    "Added to islands as they are before they are scaled to fit the square": (
        "Inseln hinzugefügt, bevor sie skaliert werden, um das Quadrat zu füllen"
    ),
    "All faces of which a corner is off by more than the angle": (
        "Alle Flächen, bei denen eine Ecke um mehr als den Winkel abweicht"
    ),
    "All visible faces": "Alle sichtbaren Flächen",
    "Angle error in degrees that is yellow.\nMore is yellow too": (
        "Winkelfehler in Grad, der gelb ist.\nMehr ist auch gelb"
    ),
    "Area in the texture for area on the surface: grey is the mean, blue less, red more": (
        "Fläche in der Textur für Fläche auf der Oberfläche: grau ist das Mittel, blau weniger, rot mehr"
    ),
    "As many faces of each mesh as the share says, the worst ones": (
        "So viele Flächen jedes Netzes, wie der Anteil sagt, und zwar die schlechtesten"
    ),
    "By any angle; fills the most": "Um jeden Winkel; füllt am meisten",
    "By quarter turns": "Um Vierteldrehungen",
    "Close all boundaries of an island but its longest for the solution.\nOff: islands with holes are refused": (
        "Für die Lösung alle Ränder einer Insel außer ihrem längsten schließen.\n"
        "Aus: Inseln mit Löchern werden abgelehnt"
    ),
    "Cut them open along edges": "Entlang von Kanten aufschneiden",
    "Do not scale islands to fit the square, beyond which they may lie.\n"
    "Unwrapped islands have the size of their surface, a unit of length a unit of UV": (
        "Inseln nicht skalieren, um das Quadrat zu füllen, über das sie hinausreichen dürfen.\n"
        "Abgewickelte haben die Größe ihrer Oberfläche, eine Längeneinheit eine Einheit der UVs"
    ),
    "Each island has the area of its surface, the object's scale included": (
        "Jede Insel hat den Inhalt ihrer Oberfläche, mit der Skalierung des Objekts"
    ),
    "Factor to the mean area that is red.\nIts inverse is blue": (
        "Faktor zum mittleren Flächeninhalt, der rot ist.\nSein Kehrwert ist blau"
    ),
    "Free: islands with two pinned UVs or more follow them. Disks: three on the boundary go to equally spaced points "
    "of the circle.\n"
    "Rectangles: four on the boundary are the corners; of a mesh without pins four selected vertices, while no face "
    "is selected": (
        "Frei: Inseln mit zwei oder mehr angehefteten UVs folgen ihnen. Scheiben: drei auf dem Rand kommen auf "
        "gleich weit entfernte Kreispunkte.\n"
        "Rechtecke: vier auf dem Rand sind die Ecken; ohne angeheftete vier ausgewählte Eckpunkte, während keine "
        "Fläche ausgewählt ist"
    ),
    "Give islands sizes in the proportion of their surfaces.\nOff: they keep theirs to each other": (
        "Inseln Größen im Verhältnis ihrer Oberflächen geben.\nAus: sie behalten ihre zueinander"
    ),
    "How far the disk is turned about its middle.\nAfter it was slid": (
        "Wie weit die Scheibe um ihre Mitte gedreht wird.\nNach dem Schieben"
    ),
    "How islands may be turned to fill more of the square.\nWhat was upright is so no more": (
        "Wie Inseln gedreht werden dürfen, um mehr vom Quadrat zu füllen.\nWas aufrecht war, ist es nicht mehr"
    ),
    "How large the flat mesh is.\nAs the Surface for patterns of true size": (
        "Wie groß das flache Netz ist.\nWie die Oberfläche für Schnittmuster in wahrer Größe"
    ),
    "How the map is computed.\nAutomatic unless time or a comparison matters": (
        "Wie die Abbildung berechnet wird.\nAutomatisch, wenn es nicht auf Zeit oder einen Vergleich ankommt"
    ),
    "How the sphere is turned.\nBefore its points move": ("Wie die Kugel gedreht wird.\nBevor ihre Punkte wandern"),
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
    "Islands of all objects are packed into one square, in Object Mode too": (
        "Die Inseln aller Objekte werden in ein Quadrat gepackt, auch im Objektmodus"
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
    "Mean angle error of each face: dark violet is none, yellow the limit and more": (
        "Mittlerer Winkelfehler jeder Fläche: dunkelviolett ist keiner, gelb die Grenze und mehr"
    ),
    "Move all vertices for the last percents of angle error, never to the worse.\n"
    "For final maps: takes about four times as long": (
        "Alle Eckpunkte für die letzten Prozente Winkelfehler verschieben, nie zum Schlechteren.\n"
        "Für endgültige Karten: dauert etwa viermal so lang"
    ),
    "Name of the preset.\nOne that there is already is replaced": (
        "Name der Voreinstellung.\nEine, die es schon gibt, wird ersetzt"
    ),
    "Of several choices the one whose map changes areas least; slower": (
        "Von mehreren die Wahl, deren Abbildung Flächeninhalte am wenigsten ändert; langsamer"
    ),
    "One factorization: the Riemann map read off a Green's function; the fastest": (
        "Eine Faktorisierung: die Riemannsche Abbildung aus einer Greenschen Funktion; am schnellsten"
    ),
    "One factorization; the fastest": "Eine Faktorisierung; am schnellsten",
    "One island fills the unit square; several are packed: of all objects in Edit Mode together, of selected objects "
    "in Object Mode each by itself": (
        "Eine Insel füllt das Einheitsquadrat; mehrere werden gepackt: im Bearbeitungsmodus die aller Objekte "
        "gemeinsam, im Objektmodus die jedes ausgewählten Objekts für sich"
    ),
    "Pixels of a square image of the size given": "Pixel eines quadratischen Bildes der angegebenen Größe",
    "Positions are the UVs": "Positionen sind die UVs",
    "Remove the overlay": "Die Farben entfernen",
    "Selected, visible faces; in Object Mode all visible faces of a mesh with no face selected": (
        "Ausgewählte, sichtbare Flächen; im Objektmodus alle sichtbaren eines Netzes, in dem keine ausgewählt ist"
    ),
    "Share of the visible faces of each mesh that is selected.\nThe worst ones": (
        "Anteil der sichtbaren Flächen jedes Netzes, der ausgewählt wird.\nDie schlechtesten"
    ),
    "Side of the image that pixels of the margin are counted on.\nFor the margin method Pixels": (
        "Seite des Bildes, auf dem die Pixel des Abstands gezählt werden.\nFür die Abstandsart Pixel"
    ),
    "Slide between the surface and its flat form; for maps that are torn nowhere": (
        "Zwischen der Oberfläche und ihrer flachen Form gleiten; für Karten, die nirgends getrennt sind"
    ),
    "Space between islands.\nWhere they have the size of the surface": (
        "Raum zwischen Inseln.\nWo sie die Größe der Oberfläche haben"
    ),
    "Space kept around every island, twice that between two.\nOne island that is unwrapped alone fills the square": (
        "Raum um jede Insel, zwischen zweien das Doppelte.\nEine Insel, die allein abgewickelt wird, füllt das Quadrat"
    ),
    "The active vertex of each object, in the island in whose interior it lies": (
        "Der aktive Eckpunkt jedes Objekts, in der Insel, in deren Innerem er liegt"
    ),
    "The algorithm of Choi's report with three pins; slow, for comparison": (
        "Der Algorithmus aus Chois Bericht mit drei festen Punkten; langsam, zum Vergleich"
    ),
    "The box around it": "Der Rahmen darum",
    "The convex hull": "Die konvexe Hülle",
    "The least angle by which a corner of a selected face is off.\nFor faces that are bad, however many": (
        "Der kleinste Winkel, um den eine Ecke einer ausgewählten Fläche abweicht.\n"
        "Für schlechte Flächen, wie viele es auch sind"
    ),
    "The least conformal energy, by Newton's method on the boundary angles; where an island is crowded, Linear may "
    "keep angles better": (
        "Die geringste konforme Energie, nach Newton in den Randwinkeln; wo eine Insel gedrängt ist, kann Linear "
        "Winkel besser erhalten"
    ),
    "The least conformal energy; for coarse meshes": "Die geringste konforme Energie; für grobe Netze",
    "The method that keeps the angles best": "Das Verfahren, das Winkel am besten erhält",
    "The octahedron unfolded to a square": "Das Oktaeder, zum Quadrat entfaltet",
    "The outline: others may come to lie in bays and holes": "Der Umriss: andere können in Buchten und Löchern liegen",
    "The place deepest inside each island": "Die Stelle am tiefsten in jeder Insel",
    "The tile to pack into.\n1001 is the first, 1002 to its right, 1011 above it": (
        "Die Kachel, in die gepackt wird.\n1001 ist die erste, 1002 rechts von ihr, 1011 über ihr"
    ),
    "To lie along the axes, and by quarter turns": "Längs der Achsen, und um Vierteldrehungen",
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
    "UV map, or vector attribute of face corners, to write; a UV map is made when missing.\nEmpty: the active one": (
        "UV-Karte, oder Vektorattribut der Flächenecken, die geschrieben wird; eine UV-Karte wird angelegt, wenn sie "
        "fehlt.\n"
        "Leer: die aktive"
    ),
    "Unfold faces that came out inverted.\nOff: they stay, and are counted": (
        "Flächen auffalten, die umgeklappt herauskamen.\nAus: sie bleiben, und werden gezählt"
    ),
    "What colours stand for.\nNothing removes the overlay": ("Wofür Farben stehen.\nNichts entfernt sie"),
    "What comes to the middle of the disk.\nArea Balance where parts come out too small": (
        "Was in die Mitte der Scheibe kommt.\nFlächenausgleich, wo Teile zu klein herauskommen"
    ),
    "What gives all parts of an island the most even share of the disk's area": (
        "Was allen Teilen einer Insel den gleichmäßigsten Anteil an der Scheibe gibt"
    ),
    "What is made.\nA shape key needs a map that is torn nowhere": (
        "Was entsteht.\nEin Formschlüssel braucht eine Karte, die nirgends getrennt ist"
    ),
    "What is packed of an island.\nExact Shape fills the most, Bounding Box keeps bays free": (
        "Was von einer Insel gepackt wird.\nDer genaue Umriss füllt am meisten, der Rahmen hält Buchten frei"
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
    "What the margin is, as in Blender's own packer.\nPixels for an image of known size": (
        "Was der Abstand ist, wie in Blenders eigenem Packer.\nPixel für ein Bild bekannter Größe"
    ),
    "What to do with islands that have no boundary, or handles.\nCut where seams are too much work": (
        "Was mit Inseln geschieht, die keinen Rand oder Henkel haben.\nAufschneiden, wo Nähte zu viel Arbeit sind"
    ),
    "Where all points move to, the farther the longer it is (less than 1).\nWhat lies opposite grows": (
        "Wohin alle Punkte wandern, umso weiter, je länger es ist (kürzer als 1).\nWas gegenüber liegt, wächst"
    ),
    "Where islands go in the texture.\nPack Together where objects share it": (
        "Wohin Inseln in der Textur kommen.\nGemeinsam packen, wo Objekte sie teilen"
    ),
    "Where the boundary turns most": "Wo der Rand sich am stärksten biegt",
    "Where the middle of the disk goes, as a part of its radius.\n"
    "To give what matters more of the texture, slide it to the middle": (
        "Wohin die Mitte der Scheibe kommt, als Teil ihres Radius.\n"
        "Was wichtig ist, bekommt in der Mitte mehr von der Textur"
    ),
    "Where the pin goes.\nIts island follows": ("Wohin die angeheftete UV kommt.\nIhre Insel folgt"),
    "Which faces are selected.\nShare to see the worst, Angle Error to see all that are bad": (
        "Welche Flächen ausgewählt werden.\nAnteil für die schlechtesten, Winkelfehler für alle schlechten"
    ),
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
    "Cancelled; nothing was changed": "Abgebrochen; nichts wurde geändert",
    "Changed since then: these numbers are of the map as it was": (
        "Seither geändert: diese Zahlen gelten der Karte, wie sie war"
    ),
    "Drag a pin or a selected boundary UV   Shift: precise   Enter: confirm   Esc, right click: cancel": (
        "Angeheftete oder ausgewählte UV am Rand ziehen   Umschalt: genau   Eingabe: bestätigen   Esc, Rechtsklick: "
        "abbrechen"
    ),
    "Drag: slide   Wheel: turn   Shift: precise   Numbers, Tab, R X Y: type   Enter, click: confirm   Esc, right "
    "click: cancel": (
        "Ziehen: schieben   Mausrad: drehen   Umschalt: genau   Ziffern, Tab, R X Y: eingeben   Eingabe, Klick: "
        "bestätigen   Esc, Rechtsklick: abbrechen"
    ),
    "Drag: turn   Wheel: magnify here   Shift: precise   Numbers, Tab, R X Y Z: type   Enter, click: confirm   Esc, "
    "right click: cancel": (
        "Ziehen: drehen   Mausrad: hier vergrößern   Umschalt: genau   Ziffern, Tab, R X Y Z: eingeben   Eingabe, "
        "Klick: bestätigen   Esc, Rechtsklick: abbrechen"
    ),
    "Face {face}: {why}": "Fläche {face}: {why}",
    "Flattened {done} of {count} mesh": "{done} von {count} Netz flach gelegt",
    "Flattened {done} of {count} meshes": "{done} von {count} Netzen flach gelegt",
    "Go to Edit Mode": "In den Bearbeitungsmodus wechseln",
    "Go to Object Mode": "In den Objektmodus wechseln",
    "Go to Object Mode or to Edit Mode of a mesh": (
        "In den Objektmodus oder in den Bearbeitungsmodus eines Netzes wechseln"
    ),
    "Islands that failed can be unwrapped with another option": (
        "Misslungene Inseln können mit einer anderen Option abgewickelt werden"
    ),
    "Mapped {count} island from pins": "{count} Insel aus angehefteten UVs abgebildet",
    "Mapped {count} islands from pins": "{count} Inseln aus angehefteten UVs abgebildet",
    "Mapped {done} of {count} mesh to a sphere": "{done} von {count} Netz auf eine Kugel abgebildet",
    "Mapped {done} of {count} meshes to spheres": "{done} von {count} Netzen auf Kugeln abgebildet",
    "Mean angle error {angle:.0f}°: let islands keep their own outline, or cut them": (
        "Mittlerer Winkelfehler {angle:.0f}°: Inseln ihren eigenen Umriss lassen oder sie aufschneiden"
    ),
    "Mean angle error {angle:.0f}°: mark seams across the worst faces, then unwrap again": (
        "Mittlerer Winkelfehler {angle:.0f}°: Nähte durch die schlechtesten Flächen markieren, dann neu abwickeln"
    ),
    "Moved {count} sphere": "{count} Kugel bewegt",
    "Moved {count} spheres": "{count} Kugeln bewegt",
    "No selected mesh has faces and a UV map": "Kein ausgewähltes Netz hat Flächen und eine UV-Karte",
    "No visible face with UVs is selected": "Keine sichtbare Fläche mit UVs ist ausgewählt",
    "Red stands for {limit:g} times the mean area and more; numbers are in {angle} and {area}": (
        "Rot steht für das {limit:g}-fache des mittleren Flächeninhalts und mehr; die Zahlen sind in {angle} und {area}"
    ),
    "Select a mesh object": "Ein Netzobjekt auswählen",
    "Select a mesh object with a UV map": "Ein Netzobjekt mit einer UV-Karte auswählen",
    "Slid {count} disk": "{count} Scheibe geschoben",
    "Slid {count} disks": "{count} Scheiben geschoben",
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
    "Yellow stands for {limit:g} degrees and more; numbers are in {angle} and {area}": (
        "Gelb steht für {limit:g} Grad und mehr; die Zahlen sind in {angle} und {area}"
    ),
    "active vertex {vertex} belongs to no selected face": (
        "der aktive Eckpunkt {vertex} gehört zu keiner ausgewählten Fläche"
    ),
    "and {count} more": "und {count} weitere",
    "it has eight UV maps already; remove one": "es hat schon acht UV-Karten; eine entfernen",
    "its scale is not uniform; apply it first": "seine Skalierung ist nicht gleichmäßig; sie zuerst anwenden",
    "no UV is selected": "keine UV ist ausgewählt",
    "no disk is selected; select its faces, or put the cursor over it": (
        "keine Scheibe ist ausgewählt; ihre Flächen auswählen, oder den Mauszeiger über sie bringen"
    ),
    "no face is visible": "keine Fläche ist sichtbar",
    "no island of the active UV map is a disk, its boundary on a circle; unwrap with the shape Disk first": (
        "keine Insel der aktiven UV-Karte ist eine Scheibe mit dem Rand auf einem Kreis; zuerst in der Form Scheibe "
        "abwickeln"
    ),
    "no pin and no selected vertex gives corners, they are automatic; pin four UVs on the boundary, or select four "
    "vertices there and no face": (
        "keine angeheftete UV und kein ausgewählter Eckpunkt gibt Ecken an, sie sind automatisch; vier UVs auf dem "
        "Rand anheften, oder dort vier Eckpunkte und keine Fläche auswählen"
    ),
    "no selected island has two pinned UVs or more; select UVs and press P to pin them": (
        "keine ausgewählte Insel hat zwei oder mehr angeheftete UVs; UVs auswählen und mit P anheften"
    ),
    "no shape key has the positions of a sphere; use Object > Conformal Sphere Map first": (
        "kein Formschlüssel hat die Positionen einer Kugel; zuerst Objekt > Konforme Kugelabbildung nutzen"
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
    "pinned UVs stay where they are; unpin them, or pin four on the boundary and turn on Use Pins": (
        "angeheftete UVs bleiben, wo sie sind; sie lösen, oder vier auf dem Rand anheften und Angeheftete nutzen "
        "einschalten"
    ),
    "pinned UVs stay where they are; unpin them, or pin three on the boundary and turn on Use Pins": (
        "angeheftete UVs bleiben, wo sie sind; sie lösen, oder drei auf dem Rand anheften und Angeheftete nutzen "
        "einschalten"
    ),
    "pinned UVs stay where they are; unpin them, or pin two or more and turn on Use Pins": (
        "angeheftete UVs bleiben, wo sie sind; sie lösen, oder zwei oder mehr anheften und Angeheftete nutzen "
        "einschalten"
    ),
    "set {option} to {value}": "{option} auf {value} stellen",
    "some of its UVs are not selected; select whole islands": (
        "einige ihrer UVs sind nicht ausgewählt; ganze Inseln auswählen"
    ),
    "the UV map is torn at {count} vertex; make a new object": (
        "die UV-Karte ist an {count} Eckpunkt getrennt; ein neues Objekt machen"
    ),
    "the UV map is torn at {count} vertices; make a new object": (
        "die UV-Karte ist an {count} Eckpunkten getrennt; ein neues Objekt machen"
    ),
    "the active UV map is no layout of the sphere; use Object > Conformal Sphere Map with UVs first": (
        "die aktive UV-Karte ist keine Karte der Kugel; zuerst Objekt > Konforme Kugelabbildung mit UVs nutzen"
    ),
    "the mesh has no UV map; unwrap it first": "das Netz hat keine UV-Karte; es zuerst abwickeln",
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
    "there is no pinned UV, and no selected one on the boundary of an island, to drag": (
        "es gibt keine angeheftete UV, und keine ausgewählte auf dem Rand einer Insel, die zu ziehen wäre"
    ),
    "there is no pinned UV, and no selected one on the boundary of an island, to drag here": (
        "hier gibt es keine angeheftete UV, und keine ausgewählte auf dem Rand einer Insel, die zu ziehen wäre"
    ),
    "there is no such UV to drag": "es gibt keine solche UV zu ziehen",
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
    "{count} more face is flipped or collapsed now": "{count} weitere Fläche ist jetzt umgeklappt oder verschwunden",
    "{count} more faces are flipped or collapsed now": (
        "{count} weitere Flächen sind jetzt umgeklappt oder verschwunden"
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
    "{name!r} is an attribute, but no vector of face corners; choose another name": (
        "{name!r} ist ein Attribut, aber kein Vektor der Flächenecken; einen anderen Namen wählen"
    ),
    "{object}, face {faces}: {why}": "{object}, Fläche {faces}: {why}",
    "{object}, faces {faces}: {why}": "{object}, Flächen {faces}: {why}",
}
